"""What the compiler may change of arithmetic, by target: docs/conventions.md, "Arithmetic"."""
import json

from repository import BUILD, ROOT

MAY_FUSE = ("bsdf/batch/kernel.cpp", "bsdf/huang/facet_kernel.cpp", "sim/exact/kernel.cpp", "sim/rod/kernel.cpp")
# Kernels that are given neither NaN nor infinity (bsdf/batch/README.md).
MAY_ASSUME_FINITE = dict.fromkeys(("bsdf/batch/kernel.cpp", "bsdf/huang/facet_kernel.cpp"), {"-ffinite-math-only", "-fno-signed-zeros"})
CHANGES_RESULTS = {"-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-ffinite-math-only", "-fassociative-math", "-freciprocal-math",
                   "-fno-signed-zeros"}


def commands():
    """Of each own source: its path in the repository or in the build, and its options."""
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        for folder in (BUILD, ROOT):
            if entry["file"].startswith(f"{folder}/") and "site-packages" not in entry["file"]:
                yield entry["file"].removeprefix(f"{folder}/"), entry["command"].split()
                break


def test_Arithmetic_FusedMultiplyAdds_AreMadeInBatchKernelsAlone():
    sources = list(commands())
    assert len(sources) > 100 and set(MAY_FUSE) <= {name for name, _ in sources}
    for name, options in sources:
        policy = [option for option in options if option.startswith("-ffp-contract")]
        assert policy == ["-ffp-contract=fast" if name in MAY_FUSE else "-ffp-contract=off"], name


def test_Arithmetic_FastMath_IsUsedNowhereElseThanStated():
    for name, options in commands():
        assert set(options) & CHANGES_RESULTS == MAY_ASSUME_FINITE.get(name, set()), name
