"""Unreal's groom schema for Alembic, version 1.5 (Epic's page "Alembic for Grooms Specification"): what an attribute is."""
import dataclasses

VERSION = (1, 5)
UNIT = "cuticle_metres_per_unit"  # of the file, beside the schema: Alembic states none


@dataclasses.dataclass(frozen=True)
class Kind:
    kinds: tuple  # of numbers
    parts: int
    scopes: tuple
    least: float = float("-inf")


INTEGERS, REALS = ("int8", "int16", "int32"), ("float32", "float64")
SCHEMA = {
    "groom_guide": Kind(INTEGERS, 1, ("con", "uni"), 0),
    "groom_group_id": Kind(("int32",), 1, ("con", "uni"), 0),
    "groom_root_uv": Kind(REALS, 2, ("uni",)),
    "groom_id": Kind(("int32",), 1, ("uni",), 0),
    "groom_color": Kind(REALS, 3, ("vtx",), 0),
    "groom_width": Kind(REALS, 1, ("con", "uni", "vtx"), 0),
    "groom_closest_guides": Kind(("int32",), 3, ("uni",), 0),
    "groom_guide_weights": Kind(("float32",), 3, ("uni",), 0),
}
