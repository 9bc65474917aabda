"""Writes head_turn.bvh: a head that looks left, right, and nods; three joints, four seconds at 30 frames a second."""
import pathlib

RATE, SECONDS = 30, 4
HEADER = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Neck
  {
    OFFSET 0 0.5 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT Head
    {
      OFFSET 0 0.1 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      End Site
      {
        OFFSET 0 0.2 0
      }
    }
  }
}
"""


def ease(x):
    """0 -> 1 with level ends (fifth-degree)."""
    x = min(max(x, 0.0), 1.0)
    return x * x * x * (x * (6 * x - 15) + 10)


def keyed(time, keys):
    """Eased interpolation between (time, value) keys."""
    for (t0, v0), (t1, v1) in zip(keys, keys[1:]):
        if time <= t1:
            return v0 + (v1 - v0) * ease((time - t0) / (t1 - t0))
    return keys[-1][1]


YAW = [(0.0, 0.0), (0.1, 0.0), (0.55, 42.0), (0.75, 42.0), (1.35, -38.0), (1.7, -38.0), (2.3, 10.0), (3.0, 0.0), (4.0, 0.0)]
NOD = [(0.0, 0.0), (0.5, 4.0), (1.3, -3.0), (2.0, 6.0), (2.6, 14.0), (3.1, -4.0), (3.6, 0.0), (4.0, 0.0)]


def frame(time):
    yaw, nod = keyed(time, YAW), keyed(time, NOD)
    neck, head = 0.35, 0.65
    values = [0, 0, 0, 0, 0, 0] + [0, neck * nod, neck * yaw] + [0, head * nod, head * yaw]
    return " ".join(f"{value:.5f}" for value in values)


def main():
    count = RATE * SECONDS + 1
    lines = [f"MOTION\nFrames: {count}\nFrame Time: {1 / RATE:.8f}"]
    lines += [frame(k / RATE) for k in range(count)]
    (pathlib.Path(__file__).parent / "head_turn.bvh").write_text(HEADER + "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
