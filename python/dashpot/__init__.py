"""Impacts on viscoelastic padding: spring-dashpot-mass networks, solved with stated errors.

    import dashpot

    report = dashpot.run("pad.toml", values={"K": "25 MN/m"})
    report["padding.peak-force"].value       # N, with .error beside it
    report.curves(["padding.force"])         # NumPy arrays over time, in SI units
    dashpot.sweep("pad.toml", {"K": "5..30 MN/m,26,log"}, ["padding.peak-force"]).to_xarray()

The engine is that of the command ``dashpot``, with the same numbers to the last bit. All values are in SI units.
"""

from ._dashpot import Measure
from ._dashpot import version as _version
from ._errors import DashpotError, DashpotWarning, RunError, SceneError
from ._scene import Report, Scene, run
from ._studies import compare, cost, rheometer, signal, vibrate
from ._verbs import (
    Result,
    Sweep,
    call,
    convert,
    cushion,
    design,
    fit,
    groups,
    sweep,
    sweep_to_parquet,
)
from .network import Model, Network, element

__version__: str = _version()

__all__ = [
    "DashpotError",
    "DashpotWarning",
    "Measure",
    "Model",
    "Network",
    "Report",
    "Result",
    "RunError",
    "Scene",
    "SceneError",
    "Sweep",
    "call",
    "compare",
    "convert",
    "cost",
    "cushion",
    "design",
    "element",
    "fit",
    "groups",
    "rheometer",
    "run",
    "signal",
    "sweep",
    "sweep_to_parquet",
    "vibrate",
]
