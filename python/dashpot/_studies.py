"""The studies of the engine as functions: their options are declared there, and are arguments by name here."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

from . import _dashpot
from ._options import annotation, in_python, keyword_of
from ._scene import Progress
from ._verbs import Result, asked_of, is_settable

_STUB = '''"""Written by `_studies.stub`; a test compares."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from ._scene import Progress, Scene
from ._verbs import Result
'''
_OPERANDS = {inspect.Parameter.POSITIONAL_ONLY: "str | Scene", inspect.Parameter.VAR_POSITIONAL: "str"}


def _function(study: Mapping[str, Any]) -> Any:
    """The function that asks a study, with its options as arguments by name."""

    def function(*operands: Any, progress: Progress | None = None, **options: Any) -> Result:
        return asked_of(study, operands, options, progress)

    kinds = inspect.Parameter
    named = [
        kinds(own.lstrip("*"), kinds.VAR_POSITIONAL if own[0] == "*" else kinds.POSITIONAL_ONLY) for own in study["operands"]
    ]
    options = [
        kinds(keyword_of(own["name"]), kinds.KEYWORD_ONLY, default=_default(own), annotation=annotation(own))
        for own in study["options"]
    ]
    settable = [kinds("set", kinds.KEYWORD_ONLY, default=None, annotation="Mapping[str, Any] | None")]
    further = [
        *(settable if is_settable(study) else ()),
        kinds("progress", kinds.KEYWORD_ONLY, default=None, annotation="Progress | None"),
    ]
    function.__name__ = function.__qualname__ = study["word"]
    function.__signature__ = inspect.Signature([*named, *options, *further], return_annotation="Result")  # type: ignore[attr-defined]
    lines = [f"    {keyword_of(own['name'])}: {in_python(study['word'], own['about'])}" for own in study["options"]]
    about = [study["about"] + ".", "", "Numbers are in SI units; a text has its unit, as ``\"20 Hz\"``.", "", "Args:"]
    of_set = "    set: values in place of those of the scene or model, by name or path; the text of a scene is a `Scene(text=…)`."
    function.__doc__ = "\n".join([*about, *lines, *([of_set] if is_settable(study) else [])])
    return function


def _default(option: Mapping[str, Any]) -> Any:
    return int(option["default"]) if option["kind"] == "count" and option["default"] else option["default"] or None


def stub() -> str:
    """The types of all of them."""
    return "\n".join([_STUB, *(f"def {name}{_signature(own)}: ...\n" for name, own in _FUNCTIONS.items())]).rstrip() + "\n"


def _signature(function: Any) -> str:
    own = inspect.signature(function)
    scenes = [one.replace(annotation=_OPERANDS[one.kind]) if one.kind in _OPERANDS else one for one in own.parameters.values()]
    texts = [str(one).replace("'", "") if "Literal" not in str(one.annotation) else _of_words(one) for one in scenes]
    last = sum(one.kind is one.POSITIONAL_ONLY for one in scenes)
    parts = [*texts[:last], "/", "*", *texts[last:]] if last else texts
    return "(\n    " + ",\n    ".join(parts) + ",\n) -> Result"


def _of_words(one: inspect.Parameter) -> str:
    return f"{one.name}: {one.annotation} = {one.default!r}"


_FUNCTIONS = {own["word"]: _function(own) for own in _dashpot.studies()}
compare, cost, rheometer, signal, vibrate = (_FUNCTIONS[name] for name in ("compare", "cost", "rheometer", "signal", "vibrate"))
