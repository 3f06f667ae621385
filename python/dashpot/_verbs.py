"""The verbs of the command, with the same numbers: each returns its object of ``--json``."""

from __future__ import annotations

import itertools
import json
import os
import pathlib
import tempfile
import warnings
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from . import _dashpot
from ._errors import DashpotWarning, RunError, SceneError, warn
from ._options import arguments, check, in_python, keyword_of, options_of, values
from ._scene import Progress, Report, Scene, keys


class Result(dict[str, Any]):
    """What a verb found, in SI units, as ``--json`` has it; `status` is the exit code of the command: 0, or 3 where
    two models are not the same, or 4 where a limit that is enforced is not kept. `notes` is what was said besides.
    """

    def __init__(self, found: Mapping[str, Any], status: int, said: list[dict[str, Any]]) -> None:
        super().__init__(found)
        self.status, self.said = status, said

    @property
    def notes(self) -> list[str]:
        """What was said besides, in sentences."""
        return [own["message"] for own in self.said if own["tone"] == "note"]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self), self.status, self.said)


def call(
    verb: str, *operands: Any, progress: Progress | None = None, **options: Any
) -> Result:
    """Calls a verb of the command: ``call("vibrate", "a.toml", method="bdf")``.

    Args:
        operands: paths and words; a `Scene` stands for its text.
        options: those of the command, with ``_`` for dashes (and ``from_``, where it is a word of Python): a text, a number in SI units, a
            list of them, ``True`` or ``False`` for what is on or off, and for ``vary`` a dictionary of names and values.

    Raises:
        TypeError: the verb has no such option, or no object.
        SceneError, RunError: as the command ends with exit code 2 and 1.
    """
    if "json" not in (options_of(verb) or {"json"}):
        raise TypeError(f"`dashpot {verb}` has no `--json`, and so no object")
    if verb in _STUDIES:
        return asked_of(_STUDIES[verb], operands, options, progress)
    status, output, said = _answer(verb, operands, {**options, "json": True}, progress)
    found = json.loads(output)
    _warn(verb, operands, said, found)
    return Result(found, status, said)


def _called(
    verb: str, operands: tuple[Any, ...], options: Mapping[str, Any], progress: Progress | None
) -> tuple[int, str, list[dict[str, Any]]]:
    status, output, said = _answer(verb, operands, options, progress)
    _warn(verb, operands, said, None)
    return status, output, said


_STUDIES = {own["word"]: own for own in _dashpot.studies()}


def asked_of(
    study: Mapping[str, Any], operands: tuple[Any, ...], options: Mapping[str, Any], progress: Progress | None = None
) -> Result:
    """What a study answers to these options."""
    texts: dict[str, str] = {}
    words = [_operand(own, texts) for own in operands]
    scene = next((own for own in operands if isinstance(own, Scene)), None)
    verb, wanted = study["word"], study["operands"]
    if not (len(words) == len(wanted) or wanted == ["scene"] and not words or words and wanted[0][0] == "*"):
        given = f"`{verb}` takes {' and '.join(wanted).lstrip('*')}, and options by name; {len(words)} were given"
        raise SceneError([{"tone": "error", "message": given, **dict.fromkeys(("code", "help", "file", "line", "column"))}])
    known = {keyword_of(name): own["name"] for own in study["options"] for name in (own["name"], own["alias"]) if name}
    own = {keyword_of(name): value for name, value in options.items()}
    further = [name for name in own if name not in known and name != "set"]
    if further and all(name in (options_of(verb) or {}) for name in further):
        # What the command alone does, such as to write a folder.
        status, output, said = _answer(verb, operands, {**options, "json": True}, progress)
        found = json.loads(output)
        _warn(verb, operands, said, found)
        return Result(found, status, said)
    check(verb, own, [*known, *(["set"] if is_settable(study) else [])])
    pairs = _set(own.pop("set", None) or {})
    request = {known[name]: value for name, value in own.items()}
    try:
        status, found, said = _dashpot.ask(verb, words, pairs, request, texts, progress)
    except (SceneError, RunError) as error:
        raise type(error)(_in_python(verb, error.faults)) from None
    _warn(verb, operands, said, found)
    return Result(found, status, said)


def is_settable(study: Mapping[str, Any]) -> bool:
    """Whether values can be set in what a study is asked about: not in files of measurements."""
    return not study["operands"][0].startswith("*")


def _set(given: Any) -> list[tuple[str, Any]]:
    """Names and their values: of a dictionary, or of one or several texts with ``=`` between them."""
    if isinstance(given, Mapping):
        return list(given.items())
    pairs = [own.rsplit("=", 1) for own in ([given] if isinstance(given, str) else given)]
    return [(name.strip(), value.strip()) for name, value in pairs]


def _in_python(verb: str, faults: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Faults with options as they are written in Python."""
    return [
        {**own, "message": in_python(verb, own["message"]), "help": in_python(verb, own["help"])} for own in faults
    ]


def _answer(
    verb: str, operands: tuple[Any, ...], options: Mapping[str, Any], progress: Progress | None
) -> tuple[int, str, list[dict[str, Any]]]:
    texts: dict[str, str] = {}
    words = [_operand(own, texts) for own in operands]
    scene = next((own for own in operands if isinstance(own, Scene)), None)
    own = arguments(verb, options, scene)
    status, output, said = _dashpot.call([verb, *words, *own], texts, progress)
    if status in (1, 2):
        errors = _in_python(verb, [own for own in said if own["tone"] == "error"])
        raise (SceneError if status == 2 else RunError)(errors)
    return status, output, said


def _warn(verb: str, operands: tuple[Any, ...], said: list[dict[str, Any]], found: Any) -> None:
    """Warns of what was said and no scene has been warned of, with the codes that the object has, or else the verb's
    word."""
    new = [own for own in said if own["tone"] == "warning"]
    known = {text for own in operands if isinstance(own, Scene) for _, text in own.warnings} if new else set()
    codes = dict(_codes(found)) if new else {}
    for own in new:
        # Before a warning may stand where it is.
        of = [text for text in codes if own["message"].endswith(text)]
        if own["message"] not in known:
            warn(own["message"], own["code"] or (codes[max(of, key=len)] if of else verb))


def _codes(found: Any) -> Iterator[tuple[str, str]]:
    """The words of all warnings in an object, with their codes."""
    if isinstance(found, Mapping):
        if isinstance(found.get("code"), str) and isinstance(found.get("text"), str):
            yield found["text"], found["code"]
        for own in ("warning", "note"):
            yield from zip(found.get(f"{own}s") or (), found.get(f"{own}_codes") or ())
        for own in found.values():
            yield from _codes(own)
    elif isinstance(found, list) and found and isinstance(found[0], (Mapping, list)):
        for own in found:
            yield from _codes(own)


def _operand(operand: Any, texts: dict[str, str]) -> str:
    if isinstance(operand, Scene):
        # Beside its file, so that others are found from there; under a name of its own.
        name = operand.file or "scene.toml"
        stem, end = os.path.splitext(name)
        others = (f"{stem}-{at}{end}" for at in itertools.count(2))
        while texts.get(name, operand.text) != operand.text:
            name = next(others)
        texts[name] = operand.text
        return name
    path = os.fspath(operand)
    if "\n" in str(path):
        raise ValueError("this is the text of a scene, where its path is wanted: `Scene(text=…)` takes it")
    return path


def _verb(name: str, doc: str) -> Any:
    def function(*operands: Any, progress: Progress | None = None, **options: Any) -> Result:
        return call(name, *operands, progress=progress, **options)

    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"""{doc}

    As ``dashpot {name}``: its operands, and its options with ``_`` for dashes; the object of ``--json`` in SI units.
    """
    return function



def convert(*operands: Any, **options: Any) -> str:
    """The text of a model in another form that does the same, and how nearly; as ``dashpot convert``."""
    return _called("convert", operands, options, None)[1]


fit = _verb("fit", "Fits numbers of a scene, or a material, to measurements, with their intervals.")
design = _verb("design", "The best numbers of a scene within its limits, and what no pad can beat.")
cushion = _verb("cushion", "Cushion curves: peak g over static stress.")
groups = _verb("groups", "Dimensionless groups, and whether scenes are similar.")


class Sweep:
    """A sweep: arrays over its grid, of which each parameter is one axis; of listed or sampled designs all have one.

    Attributes:
        parameters: the values of each parameter along its axis, in SI units; words as texts.
        units: the SI unit of each parameter and measure.
        object: all of it, as ``dashpot sweep --json`` has it.
    """

    def __init__(self, found: Result) -> None:
        self.object = found
        own = found["parameters"]
        self.parameters = {one["name"]: np.asarray(one["values"]) for one in own}
        self._measures = {_column(one): one for one in found["measures"]}
        self.units = {one["name"]: one["unit"] for one in own}
        self.units |= {key: one["unit"] for key, one in self._measures.items()}
        is_grid = not found["listed"]
        self.shape = tuple(len(own) for own in self.parameters.values()) if is_grid else (found["points"],)

    def __getitem__(self, key: str) -> np.ndarray:
        """The values of a measure over the grid, in its SI unit; NaN where it has none."""
        return self._array(key, "values")

    def error(self, key: str) -> np.ndarray:
        """The absolute errors of a measure over the grid; NaN where they are not known."""
        return self._array(key, "errors")

    def _array(self, key: str, what: str) -> np.ndarray:
        if key not in self._measures:
            raise KeyError(f"there is no measure {key!r}; there are {', '.join(self._measures)}")
        return np.asarray(self._measures[key][what], dtype=float).reshape(self.shape)

    @property
    def measures(self) -> list[str]:
        """The keys of its measures."""
        return list(self._measures)

    def columns(self) -> dict[str, np.ndarray]:
        """A table with one row for each point: the parameters, then each measure and its error."""
        values = list(self.parameters.values())
        if len(self.shape) == len(values) and not self.object["listed"]:
            values = [own.ravel() for own in np.meshgrid(*values, indexing="ij")]
        table = dict(zip(self.parameters, values, strict=True))
        for key in self._measures:
            table[key] = self[key].ravel()
            table[f"{key} error"] = self.error(key).ravel()
        return table

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The table as an Arrow stream, for ``pyarrow.table``, ``polars.DataFrame``, DuckDB and pandas."""
        rows = [(name, own.tolist()) for name, own in self.columns().items()]
        return _dashpot.Columns(rows).__arrow_c_stream__(requested_schema)

    def to_pandas(self) -> Any:
        """The table as a data frame of pandas."""
        import pandas

        return pandas.DataFrame(self.columns())

    def to_xarray(self) -> Any:
        """Measures and their errors over the parameters, with units as attributes."""
        import xarray

        dimensions = list(self.parameters) if not self.object["listed"] else ["design"]
        data = {}
        for key in self._measures:
            data[key] = (dimensions, self[key], {"units": self.units[key]})
            data[f"{key} error"] = (dimensions, self.error(key), {"units": self.units[key]})
        along = [[name] if not self.object["listed"] else "design" for name in self.parameters]
        coordinates = {
            name: (own, values, {"units": self.units[name] or ""})
            for own, (name, values) in zip(along, self.parameters.items(), strict=True)
        }
        return xarray.Dataset(data, coordinates, {"title": self.object["title"] or ""})

    def __repr__(self) -> str:
        axes = " × ".join(f"{name} ({len(own)})" for name, own in self.parameters.items())
        return f"<dashpot.Sweep of {axes}: {', '.join(self._measures)}>"


def sweep(
    scene: Any,
    vary: Mapping[str, Any] | None = None,
    measures: str | list[str] | tuple[str, ...] = (),
    *,
    progress: Progress | None = None,
    **options: Any,
) -> Sweep:
    """Solves a scene for all combinations of values, as ``dashpot sweep``.

    Args:
        scene: as `Scene`.
        vary: by the name of each number its values: an array in SI units, or a text such as ``"5..30 MN/m,26,log"``.
        measures: keys, such as ``["padding.peak-force"]``; all that the scene reports where none is named.
        options: those of the command: ``method``, ``points``, ``sample``, ``seed``, ``estimate``, ``threads``, ….

    Returns:
        Arrays over the grid; equal to the bit on any number of threads.
    """
    own = scene if isinstance(scene, Scene) else Scene(scene)
    return Sweep(call("sweep", own, progress=progress, **_asked(vary, measures), **options))


def sweep_to_parquet(
    scene: Any,
    folder: str | os.PathLike[str],
    vary: Mapping[str, Any] | None = None,
    measures: str | list[str] | tuple[str, ...] = (),
    *,
    progress: Progress | None = None,
    **options: Any,
) -> Result:
    """A sweep of any size, written as Parquet while it is solved, as ``dashpot sweep --parquet``; memory does not grow
    with its points. Its files are read one by one by ``pandas.read_parquet``, or all at once by DuckDB, polars and Dask as
    ``folder/*.parquet``. Its columns have the names of the CSV, with units: ``"padding.peak-force [N]"``.

    Args:
        folder: holds the points of this sweep and nothing else. What is there, whole, is not solved again: after an
            interruption the same call goes on.
        scene, vary, measures, progress, options: as of `sweep`.

    Returns:
        What is known of all points: counts, extremes, warnings, and the names of the files under ``"parquet"``.
    """
    if not isinstance(folder, (str, os.PathLike)):
        raise TypeError(f"`folder`, the second argument, is a path, not {_kind(folder)}: write (scene, folder, vary, measures)")
    own = scene if isinstance(scene, Scene) else Scene(scene)
    asked = _asked(vary, measures)
    return call("sweep", own, out=folder, parquet=True, progress=progress, **asked, **options)


def figure(report: Report) -> str:
    """Forces over time of a run as SVG, as ``run --out`` draws them."""
    with tempfile.TemporaryDirectory() as folder:
        options = {"method": report.method, "out": os.path.join(folder, "run"), "write": "figures"}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DashpotWarning)
            _called("run", (report.scene,), {**options, "json": True}, None)
        drawn = sorted(pathlib.Path(options["out"]).glob("**/force-time*.svg"))
        return drawn[0].read_text(encoding="utf-8") if drawn else ""


def _asked(vary: Any, measures: Any) -> dict[str, Any]:
    if not isinstance(vary, (Mapping, str, type(None))):
        raise TypeError(f"`vary` is a dictionary of names and their values, not {_kind(vary)}; measures come after it")
    return {"vary": vary or None, "measure": keys(measures)}


def _kind(value: Any) -> str:
    return f"a {type(value).__name__}"


def _column(measure: Mapping[str, Any]) -> str:
    return measure["key"] + (" over thickness" if measure["over_thickness"] else "")
