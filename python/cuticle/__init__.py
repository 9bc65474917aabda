"""Hair reflectance, shadows, strands, motion and pictures: what the program `cuticle` does, on numpy arrays.

Angles are in degrees where a name ends in `_deg`; everything else is SI. Bad input raises `Error`, a ValueError with the
program's message. Names and parameters are those of the registries: `models()`, `methods()`, `solvers()`, `effects()`, `passes()`,
`layouts()`, `shapings()`, `formats()`, `render_methods()`.
"""
from . import shadows
from ._errors import Error
from ._grooms import (Binding, Groom, Head, Mesh, SceneHair, bind, carry, check_groom, grow, hair_of, load_groom, make_groom, make_head, shape,
                      write)
from ._models import (Batch, Gradients, Samples, absorption_of_assembly, absorption_of_fibre, absorption_of_pigments, albedo, bake,
                      check_model, eval, gradients, hair_mapping, hairs, lobes, models, pdf, sample)
from ._registries import effects, formats, layouts, methods, passes, render_methods, shapings, solvers
from ._rendering import Pass, Plan, Renderer, plan, render, scene_schema, tone_map
from ._simulation import Simulation, State, simulate

__all__ = ["Batch", "Binding", "Error", "Gradients", "Groom", "Head", "Mesh", "Pass", "Plan", "Renderer", "Samples", "SceneHair",
           "Simulation", "State", "absorption_of_assembly", "absorption_of_fibre", "absorption_of_pigments", "albedo", "bake", "bind",
           "carry", "check_groom", "check_model", "effects", "eval", "formats", "gradients", "grow", "hair_mapping", "hair_of", "hairs",
           "layouts", "load_groom", "lobes", "make_groom", "make_head", "methods", "models", "passes", "pdf", "plan", "render",
           "render_methods", "sample", "scene_schema", "shadows", "shape", "shapings", "simulate", "solvers", "tone_map", "write"]
