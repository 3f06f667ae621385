"""Written by `_studies.stub`; a test compares."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from ._scene import Progress, Scene
from ._verbs import Result

def compare(
    first: str | Scene,
    second: str | Scene,
    /,
    *,
    impact: str | None = None,
    set: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Result: ...

def rheometer(
    model: str | Scene,
    /,
    *,
    test: Literal['creep', 'creep-recovery', 'load-hold-unload', 'relaxation', 'constant-rate', 'load-unload', 'sweep'] | Sequence[Literal['creep', 'creep-recovery', 'load-hold-unload', 'relaxation', 'constant-rate', 'load-unload', 'sweep']] | None = None,
    with_: Mapping[str, str | float] | None = None,
    method: Literal['auto', 'bdf', 'tr-bdf2', 'esdirk34', 'tsit45', 'dop853', 'exact'] | Sequence[Literal['auto', 'bdf', 'tr-bdf2', 'esdirk34', 'tsit45', 'dop853', 'exact']] | None = None,
    measured: str | None = None,
    set: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Result: ...

def vibrate(
    scene: str | Scene,
    /,
    *,
    drive: str | None = None,
    from_: str | float | None = None,
    to: str | float | None = None,
    points: int = 200,
    of: str | Sequence[str] | None = None,
    at: str | float | None = None,
    amplitude: str | float | None = None,
    set: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Result: ...

def cost(
    scene: str | Scene,
    /,
    *,
    method: Literal['auto', 'bdf', 'tr-bdf2', 'esdirk34', 'tsit45', 'dop853', 'exact'] | Sequence[Literal['auto', 'bdf', 'tr-bdf2', 'esdirk34', 'tsit45', 'dop853', 'exact']] | None = None,
    measure: str | Sequence[str] | None = None,
    budget: int | None = None,
    repeat: int | None = None,
    set: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Result: ...

def signal(
    *files: str,
    channel: str | Sequence[str] | None = None,
    units: str | Sequence[str] | None = None,
    rate: str | float | None = None,
    offset: str | float | None = None,
    invert: bool | None = None,
    cfc: int | None = None,
    padding: Literal['odd', 'even', 'hold', 'none', 'zero'] | None = None,
    from_: str | float | None = None,
    to: str | float | None = None,
    velocity: str | float | None = None,
    mass: str | float | None = None,
    touch: str | float | None = None,
    falls: bool | None = None,
    guided: str | None = None,
    displacement: str | None = None,
    limit: str | Sequence[str] | None = None,
    enforce: bool | None = None,
    progress: Progress | None = None,
) -> Result: ...
