"""Mean FLIP and its map for the pictures of a study, by the package flip-evaluator: each against the one it stands beside."""
import json
import os

import numpy
from matplotlib import image

from . import ReportError, page

FILE = "flip.json"


def evaluate(reference, picture):
    """The mean FLIP of two PNGs, 0 .. 1, and its map in colours."""
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # read when the package is loaded: of small pictures, its threads cost nine times the work
    try:
        import flip_evaluator
    except ImportError as error:
        raise ReportError("FLIP needs the Python package flip-evaluator (scripts/requirements.txt)") from error
    values = [numpy.ascontiguousarray(image.imread(path)[..., :3], dtype=numpy.float32) for path in (reference, picture)]
    colors, mean, _ = flip_evaluator.evaluate(values[0], values[1], "LDR")
    return mean, colors


def measure(study):
    """Mean FLIP by file, also written to flip.json; the maps go beside the pictures as FILE_flip.png."""
    means = {}
    for picture in study.raw["pictures"]:
        if not picture["beside"]:
            continue
        mean, colors = evaluate(study.folder / picture["beside"], study.folder / picture["file"])
        means[picture["file"]] = round(float(mean), 6)
        image.imsave(study.folder / picture["file"].replace(".png", "_flip.png"), numpy.clip(colors, 0, 1))
    if means:
        page.write(study.folder / FILE, json.dumps(means, indent=1) + "\n")
    return means
