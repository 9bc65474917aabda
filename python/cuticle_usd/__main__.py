"""python -m cuticle_usd IN OUT: a USD file in another of USD's formats, flattened into one layer. Exit code 0: done; 3: USD cannot
read or write it; 4: no usd-core; 5: USD has no plug-in for a format (Alembic, mostly)."""
import os
import sys

try:
    from pxr import Sdf, Tf, Usd
except ImportError:
    sys.exit(4)


def convert(source, target):
    for path in (source, target):
        if not Sdf.FileFormat.FindByExtension(os.path.splitext(path)[1].lstrip(".")):
            return 5
    try:
        stage = Usd.Stage.Open(source)
        return 0 if stage and stage.Export(target) else 3
    except Tf.ErrorException as error:
        print(error, file=sys.stderr)
        return 3


if __name__ == "__main__":
    sys.exit(convert(*sys.argv[1:3]))
