"""python -m cuticle_abc read IN.abc OUT.npz SAID | write IN.npz OUT.abc SAID UNIT TOOL | schema IN.abc SAID.

SAID is a text that this program makes first, so that its caller knows that it ran: one sentence a line (read: the unit in metres first,
0 where the file states none). Exit code 0: done; 3: Alembic cannot read or write it, SAID says why; 4: no alembic3d."""
import os
import resource
import sys

try:
    import alembic3d  # noqa: F401
    import numpy
except ImportError:
    sys.exit(4)

from . import curves_in, curves_out, schema  # noqa: E402


def limit_memory(path):
    """A damaged file may claim any size: what is far over the file's own is refused by the system."""
    allowed = 6 * 2**30 + 40 * os.path.getsize(path)
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (allowed if most == resource.RLIM_INFINITY else min(allowed, most), most))


def main(action, source, *rest):
    said = rest[0] if action == "schema" else rest[1]
    with open(said, "w", encoding="utf-8") as out:
        try:
            limit_memory(source)
            numpy.seterr(all="ignore")  # damaged numbers are refused by the groom's own reader
            if action == "read":
                lines = curves_in.read(source, rest[0])
            elif action == "write":
                lines = curves_out.write(source, rest[0], float(rest[2]), rest[3])
            else:
                lines = schema.check(source)
        except (RuntimeError, ValueError, OSError, MemoryError, TypeError, IndexError, KeyError, OverflowError) as error:
            words = " ".join(str(error).split()) or type(error).__name__
            out.write(words.replace("Unknown core type", "it is no Alembic file, or a damaged one")[:300] + "\n")
            return 3
        out.writelines(line + "\n" for line in lines)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
