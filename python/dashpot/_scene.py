"""Scenes, and runs of them."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from . import _dashpot
from ._errors import DashpotWarning, warn
from ._options import checked, closest
from ._toml import to_toml

Progress = Callable[[float], object]


class Scene:
    """A scene: nodes, elements, effects, loads, and how it is run. It does not change.

    Args:
        source: a path, the name of a built-in scene such as ``"reference"``, a ``dict`` of the shape of the scene
            format, or what is composed by `dashpot.network`.
        values: numbers and words in place of its own, by name or path: ``{"K": "25 MN/m", "head.mass": 4.5}``. A bare
            number is in SI units.
        text: the text of a scene, in place of ``source``.

    Raises:
        SceneError: all faults of the text, each with its place and what to do.
    """

    def __init__(
        self,
        source: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        values: Mapping[str, Any] | None = None,
        *,
        text: str | None = None,
        _file: str | None = None,
    ) -> None:
        if source is not None and text is not None:
            raise TypeError("a scene is of a source or of a text")
        file = _file
        if isinstance(source, Scene):
            text, file = source._base, source.file
            values = {**source._values, **(values or {})}
        elif hasattr(source, "as_scene"):
            text = to_toml(source.as_scene())
        elif isinstance(source, Mapping):
            text = to_toml(source)
        elif text is None:
            file, text = _dashpot.opened(source or "reference")
        self._base, self.file = text, file
        self._values = dict(values or {})
        plain = _dashpot.Scene(text, file) if self._has_numbers() else None
        self._set = [(name, _written(plain, name, value)) for name, value in self._values.items()]
        self._own = _dashpot.Scene(text, file, self._set)
        self._said = self._own.said
        for own in self._said:
            if own["tone"] == "warning":
                warn(own["message"], own["code"] or "scene")

    def _has_numbers(self) -> bool:
        return any(not isinstance(own, str) for own in self._values.values())

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._base, self.file, self._values)

    def __repr__(self) -> str:
        return f"<dashpot.Scene {self.title or self.file or 'without title'!r}>"

    def _repr_html_(self) -> str:
        return f"{self._own.drawing()}<pre>{_escaped(self.text)}</pre>"

    @property
    def title(self) -> str | None:
        """Its title."""
        return self._own.title

    @property
    def text(self) -> str:
        """Its text, with the values that were set."""
        return self._own.text

    @property
    def numbers(self) -> dict[str, tuple[float, str]]:
        """Its numbers by name: the value and its SI unit."""
        return {name: (value, unit) for name, value, unit, _ in self._own.numbers()}

    @property
    def warnings(self) -> list[tuple[str, str]]:
        """What is odd about it, and which measures can have no value: code and text."""
        return [(own["code"] or "scene", own["message"]) for own in self._said if own["tone"] == "warning"]

    @property
    def notes(self) -> list[tuple[str, str]]:
        """What is to be said about its models besides: code and text."""
        return [(own["code"], own["message"]) for own in self._said if own["tone"] == "note"]

    @property
    def files(self) -> list[str]:
        """Other files that it reads."""
        return self._own.files

    def with_values(self, values: Mapping[str, Any]) -> Scene:
        """The same with other values, as in `Scene`."""
        return Scene(self, values)

    def written(self, name: str, value: float) -> str:
        """A value in SI units of a number of it, with its unit: read back, it is the same to the bit."""
        return self._own.written(name, float(value))

    @checked
    def run(
        self,
        method: str | None = None,
        *,
        accuracy: float | None = None,
        neglect: float | None = None,
        rtol: float | None = None,
        estimate: bool = True,
        budget: int | None = None,
        measures: str | Iterable[str] = (),
        sample: int = 500,
        seed: int = 1,
        floor: bool = False,
        progress: Progress | None = None,
    ) -> Report:
        """Solves it; as `dashpot.run`."""
        asked = {
            "method": method,
            "accuracy": accuracy,
            "neglect": neglect,
            "rtol": rtol,
            "estimate": estimate,
            "budget": budget,
            "measures": keys(measures),
            "sample": sample,
            "seed": seed,
            "floor": floor,
        }
        own = self._own.solve(**asked, progress=progress)
        for code, text in own.new_warnings:
            warn(text, code)
        return Report(self, own, asked)


class Report(Mapping[str, Any]):
    """A run: its measures by their keys, as ``report["padding.peak-force"].value`` in N.

    Each measure has ``value``, ``error`` (absolute), ``unit`` (SI), ``time`` and ``window`` (s), and ``note``; where it
    has no value, ``value`` is ``None`` and ``note`` says why.
    """

    def __init__(self, scene: Scene, own: Any, asked: Mapping[str, Any]) -> None:
        self.scene = scene
        self._own, self._asked = own, asked

    def __reduce__(self) -> tuple[Any, ...]:
        own = self._own
        of_run = (own.keys(), own.measures(), own.json(), own.method, own.end, own.wall, own.warnings)
        told = _Told(self.scene, self._asked, *of_run)
        return Report, (self.scene, told, self._asked)

    def __getitem__(self, key: str) -> Any:
        return self._own.measure(key)

    def __iter__(self) -> Iterator[str]:
        return iter(self._own.keys())

    def __len__(self) -> int:
        return len(self._own.keys())

    @property
    def method(self) -> str:
        """The method that solved it."""
        return self._own.method

    @property
    def wall(self) -> float:
        """What the engine took for it by the clock, in s."""
        return self._own.wall

    @property
    def warnings(self) -> list[tuple[str, str]]:
        """Its warnings: code and text, the most important first."""
        return self._own.warnings

    @property
    def notes(self) -> list[tuple[str, str]]:
        """What is to be said about the models of its scene: code and text."""
        return self.scene.notes

    @cached_property
    def object(self) -> dict[str, Any]:
        """All of it, as ``dashpot run --json`` has it among its ``runs``: SI units."""
        return json.loads(self._own.json())

    def curves(
        self, names: Iterable[str] | None = None, times: Any = None, *, count: int = 501
    ) -> dict[str, np.ndarray]:
        """Outputs over time, by name, with ``"time"`` before them; all in SI units.

        Args:
            names: such as ``["padding.force", "head.acceleration"]``; all where none is named.
            times: increasing times in s within the run; ``count`` regular ones where none are given.
        """
        wanted = None if times is None else np.asarray(times, dtype=float).ravel().tolist()
        time, columns = self._own.outputs(wanted, count)
        names = list(columns) if names is None else list(names)
        unknown = [name for name in names if name not in columns]
        if unknown:
            raise KeyError(f"there is no output {unknown[0]!r}; there are {', '.join(columns)}")
        return {"time": time, **{name: columns[name][1] for name in names}}

    def units(self) -> dict[str, str]:
        """The SI unit of each output over time."""
        _, columns = self._own.outputs([], 0)
        return {"time": "s", **{name: own[0] for name, own in columns.items()}}

    def to_pandas(self, *, count: int = 501) -> Any:
        """All outputs over time as a table of pandas, with the time in s as its index."""
        import pandas

        return pandas.DataFrame(self.curves(count=count)).set_index("time")

    def __repr__(self) -> str:
        rows = [self[key] for key in self]
        return "\n".join([f"<dashpot.Report by {self.method}>", *(f"  {own!r}" for own in rows)])

    def _repr_html_(self) -> str:
        from ._verbs import figure

        rows = "".join(_row(self[key]) for key in self)
        told = "".join(f"<p><b>warning:</b> {_escaped(text)}</p>" for _, text in self.warnings)
        told += "".join(f"<p>{_escaped(text)}</p>" for _, text in self.notes)
        head = "<tr><th>measure</th><th>value</th><th>error</th><th>unit</th><th>at [s]</th></tr>"
        return f"{told}{figure(self)}<table>{head}{rows}</table>"


@dataclass(frozen=True)
class _Told:
    """What was told of a run, as it is pickled. Its curves are solved for again, to the same bits, if they are asked
    for.
    """

    scene: Scene
    asked: Mapping[str, Any]
    told: list[str]
    all: list[Any]
    text: str
    method: str
    end: float
    wall: float
    warnings: list[tuple[str, str]]

    def keys(self) -> list[str]:
        return self.told

    def measures(self) -> list[Any]:
        return self.all

    def measure(self, key: str) -> Any:
        for own in self.all:
            if own.key == key:
                return own
        raise KeyError(f"there is no measure {key!r}{closest(key, [own.key for own in self.all])}")

    def json(self) -> str:
        return self.text

    def outputs(self, times: list[float] | None, count: int) -> Any:
        return self._again.outputs(times, count)

    @cached_property
    def _again(self) -> Any:
        return self.scene._own.solve(**self.asked)


def run(
    scene: Any = None,
    values: Mapping[str, Any] | None = None,
    method: str | None = None,
    **options: Any,
) -> Report:
    """Solves a scene by one method, with the numbers of ``dashpot run --json``.

    Args:
        scene: as `Scene`; the reference impact where none is given.
        values: numbers in place of its own, as `Scene`.
        method: such as ``"exact"`` or ``"bdf"``; the scene's where it names one, else ``"auto"``.
        accuracy: of every measure, relative, such as ``1e-4``; the scene's where none is given, else 0.1 %.
        neglect: leaves out what moves no measure by more than this, relative.
        rtol: the method's own tolerance in place of the search for one.
        estimate: whether errors are estimated by further solutions.
        budget: most work, in units of a step of one unknown, some 30 ns.
        measures: keys of the measures that are told; all that the scene reports where none is named.
        sample: so many designs are drawn where numbers of the scene have scatter; none with 0.
        seed: which designs are drawn.
        floor: tells in ``report.object["floor"]`` what no pad can beat.
        progress: is called with the share that is done, some 20 times a second.

    Raises:
        SceneError: the scene, a value or an option is wrong.
        RunError: no method gets through, or the energy does not close.

    Warns:
        DashpotWarning: with its ``code``, what the reader of the numbers must know.
    """
    own = scene if isinstance(scene, Scene) and not values else Scene(scene, values)
    return own.run(method, **options)


def _unpickled(text: str, file: str | None, values: dict[str, Any]) -> Scene:
    scene = Scene.__new__(Scene)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DashpotWarning)
        Scene.__init__(scene, None, values, text=text, _file=file)
    return scene


def keys(measures: str | Iterable[str]) -> list[str]:
    """Keys of measures; those of one text have commas between them."""
    return [own.strip() for own in measures.split(",")] if isinstance(measures, str) else list(measures)


def _written(scene: Any, name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    return scene.written(name, float(value))


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _row(own: Any) -> str:
    value = "–" if own.value is None else f"{own.value:.6g}"
    error = "–" if own.error is None else f"{own.error:.1e}"
    time = "–" if own.time is None else f"{own.time:.6g}"
    cells = (_escaped(own.key), value, error, _escaped(own.unit), time)
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
