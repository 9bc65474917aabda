"""Hair reflectance, shadows, strands, motion and pictures: what the program `cuticle` does, on numpy arrays.

Angles are in degrees where a name ends in `_deg`; everything else is SI. Bad input raises `Error`, a ValueError with the
program's message. Names and parameters are those of the registries: `models()`, `methods()`, `solvers()`, `effects()`, `passes()`,
`layouts()`, `shapings()`, `formats()`, `render_methods()`, `studies()`, `sweeps.tasks()`.
"""
from . import shadows, view, sweeps
from ._cuticle import set_threads, version as _version
from ._errors import Error
from ._fitting import Fit, fit
from ._grooms import (Binding, Cards, Groom, Head, Mesh, SceneHair, bind, carry, check_groom, grow, hair_of, load_groom, make_cards, make_groom,
                      make_head, shape, write)
from ._models import (Batch, Gradients, Samples, absorption_of_assembly, absorption_of_fibre, absorption_of_pigments, albedo, check_model, conformance, eval, gradients, hair_mapping, hairs, lobes, models, pdf, sample)
from ._registries import effects, formats, layouts, methods, passes, render_methods, shapings, solvers
from ._rendering import Pass, Plan, Renderer, plan, render, scene_schema, tone_map
from ._simulation import Rest, Simulation, State, simulate
from ._studies import Study, studies, study
from ._tables import AnalyticFit, bake, check_tables, fit_analytic, read_tables, snippet, table_choices
from .sweeps import sweep

__version__ = _version()

__all__ = ["AnalyticFit", "Batch", "Binding", "Cards", "Error", "Fit", "Gradients", "Groom", "Head", "Mesh", "Pass", "Plan", "Renderer",
           "Rest", "Samples", "SceneHair", "Simulation", "State", "Study", "absorption_of_assembly", "absorption_of_fibre",
           "absorption_of_pigments", "albedo", "bake", "bind", "carry", "check_groom", "check_model", "check_tables", "conformance", "effects",
           "eval", "fit", "fit_analytic", "formats", "gradients", "grow", "hair_mapping", "hair_of", "hairs", "layouts",
           "load_groom", "lobes", "make_cards", "make_groom", "make_head", "methods", "models", "passes", "pdf", "plan", "read_tables", "render",
           "render_methods", "sample", "scene_schema", "set_threads", "shadows", "shape", "shapings", "simulate", "snippet",
           "solvers", "studies", "study", "sweep", "sweeps", "table_choices", "tone_map", "view", "write"]
