"""Options of the verbs: arguments by name in place of those of the command line."""

from __future__ import annotations

import difflib
import functools
import inspect
import keyword
import numbers
import os
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, ParamSpec, TypeVar

import numpy as np

from . import _dashpot

# What scenes and studies name in their own way.
_ALIKE = {"values": "set", "set": "values"}
_P = ParamSpec("_P")
_R = TypeVar("_R")
# Whole commands in quotation marks stay as they are.
_QUOTED = re.compile(r"`dashpot [^`]*`|([`'])(--[^`']*)\1|(--[a-z-]+)")
_FLAG = re.compile(r"--([a-z-]+)(.*)", re.S)


class Option(NamedTuple):
    """An option of the command: without dashes before its name, with the SI unit of its numbers."""

    name: str
    is_repeated: bool
    unit: str
    words: list[str]


@functools.cache
def options_of(verb: str) -> dict[str, Option] | None:
    """The options of a verb by their names in Python; of another verb the command has something to say."""
    found = _dashpot.options(verb)
    return None if found is None else {keyword_of(own[0]): Option(*own) for own in found}


def arguments(verb: str, options: Mapping[str, Any], scene: Any) -> list[str]:
    """The options as words of a command line."""
    known = options_of(verb)
    if known is None:
        return []
    own = {keyword_of(name): value for name, value in options.items()}
    check(verb, own, known)
    return [word for name, value in own.items() for word in _words(known[name], value, scene)]


def check(function: str, options: Iterable[str], known: Iterable[str]) -> None:
    """Raises a `TypeError` where one of them is not known."""
    known = list(known)
    for name in options:
        if name not in known:
            raise TypeError(f"{function}() has no option {name!r}{closest(name, known)}")


def checked(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """The function, which names the closest options where it has no such one."""
    own = inspect.signature(function).parameters

    @functools.wraps(function)
    def wrapped(*args: _P.args, **options: _P.kwargs) -> _R:
        check(function.__name__, options, [name for name in own if name != "self"])
        return function(*args, **options)

    return wrapped


def closest(name: str, known: list[str]) -> str:
    """What may be meant, and what there is, as the end of a sentence."""
    near = [_ALIKE[name]] if _ALIKE.get(name) in known else difflib.get_close_matches(name, known)
    meant = f": did you mean {' or '.join(map(repr, near))}? There" if near else "; there"
    return f"{meant} are {', '.join(known)}"


def in_python(verb: str, text: str | None) -> str | None:
    """A sentence of the command with its options as they are written in Python."""
    known = options_of(verb) or {}

    def flag(text: str) -> str | None:
        own = _FLAG.fullmatch(text.strip())
        if own is None or keyword_of(own[1]) not in known:
            return None
        name, value = own[1], own[2].strip(" =.")
        if not value or value.startswith("<"):
            return keyword_of(name)
        return f"{keyword_of(name)}={value}" if value[0] == '"' else f'{keyword_of(name)}="{value}"'

    def written(found: re.Match[str]) -> str:
        if not (found[2] or found[3]):
            return found[0]
        flags = [flag(own) for own in re.split(r" (?=--[a-z])", found[2] or found[3])]
        return found[0] if None in flags else f"`{', '.join(flags)}`"

    return text and _QUOTED.sub(written, text)


def values(name: str, value: Any, scene: Any) -> str:
    """Values of a number of a scene, or of words, with commas between them."""
    if isinstance(value, str):
        return value
    own = np.asarray(value, dtype=object).ravel().tolist()
    is_plain = [isinstance(one, str) or scene is None for one in own]
    return ",".join(_text(one, "") if plain else scene.written(name, one) for one, plain in zip(own, is_plain))


def annotation(option: Mapping[str, Any]) -> str:
    """What a study's option takes, as its type."""
    kinds = {"text": "str", "count": "int", "quantity": "str | float", "amount": "str | float", "assignment": "Mapping[str, str | float]", "switch": "bool"}
    words = "Literal[" + ", ".join(map(repr, option["words"])) + "]" if option["kind"] == "words" else ""
    own = words or kinds[option["kind"]]
    if option["several"] and option["kind"] != "assignment":
        own = f"{own} | Sequence[{own}]" if words else f"{own} | Sequence[str]"
    return own if option["default"] else f"{own} | None"


def keyword_of(name: str) -> str:
    """The name of an option in Python."""
    name = name.replace("-", "_")
    return f"{name}_" if keyword.iskeyword(name) else name


def _words(option: Option, value: Any, scene: Any) -> list[str]:
    flag = f"--{option.name}"
    if isinstance(value, (bool, np.bool_)):
        if "always" in option.words:
            return [f"{flag}={'always' if value else 'never'}"]
        if "off" in option.words:
            on = "on" if "on" in option.words else option.words[0]
            return [f"{flag}={on if value else 'off'}"]
        return [flag] if value else []
    if value is None:
        return []
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, Mapping):
        all_ = [f"{key}={values(key, own, scene)}" for key, own in value.items()]
    elif isinstance(value, Iterable) and not isinstance(value, (str, os.PathLike)):
        all_ = [_text(own, option.unit) for own in value]
    else:
        all_ = [_text(value, option.unit)]
    if not option.is_repeated:
        all_ = [",".join(all_)] if all_ else []
    return [f"{flag}={own}" for own in all_]


def _text(value: Any, unit: str) -> str:
    if isinstance(value, numbers.Real):
        own = str(int(value)) if isinstance(value, numbers.Integral) else repr(float(value))
        return f"{own} {unit}".rstrip()
    return value if isinstance(value, str) else os.fspath(value)
