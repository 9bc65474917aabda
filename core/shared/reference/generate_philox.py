"""Writes philox.csv: Philox4x32-10 blocks computed with Python's whole numbers from the paper's definition.

Run by hand. Salmon, Moraes, Dror, Shaw, "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011, section 4.
"""
import pathlib
import random

MASK = 2**32 - 1


def philox(counter, key):
    v = list(counter)
    k = list(key)
    for _ in range(10):
        first, second = 0xD2511F53 * v[0], 0xCD9E8D57 * v[2]
        v = [(second >> 32) ^ v[1] ^ k[0], second & MASK, (first >> 32) ^ v[3] ^ k[1], first & MASK]
        k = [(k[0] + 0x9E3779B9) & MASK, (k[1] + 0xBB67AE85) & MASK]
    return v


if __name__ == "__main__":
    random.seed(1)
    lines = ["counter_a,counter_b,counter_c,counter_d,key_0,key_1,a,b,c,d"]
    for _ in range(40):
        words = [random.getrandbits(32) for _ in range(6)]
        lines.append(",".join(str(w) for w in words + philox(words[:4], words[4:])))
    pathlib.Path(__file__).with_name("philox.csv").write_text("\n".join(lines) + "\n")
    print([hex(w) for w in philox((0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344), (0xA4093822, 0x299F31D0))])
