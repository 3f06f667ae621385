"""Scenes as text."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

# Says to the command that numbers without a unit are meant in SI units.
_UNITS = "#:units SI\n"
_BARE = re.compile(r"[A-Za-z0-9_-]+")


def to_toml(scene: Mapping[str, Any]) -> str:
    """The text of a scene of dictionaries, lists, texts, numbers and truth values."""
    lines = [f"{_key(key)} = {_value(own)}" for key, own in scene.items() if not _is_table(own)]
    for key, own in scene.items():
        if _is_table(own):
            lines += ["", f"[{_key(key)}]"]
            lines += [f"{_key(inner)} = {_value(value)}" for inner, value in own.items()]
    return "\n".join(lines).lstrip("\n") + "\n" + _UNITS


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else json.dumps(key, ensure_ascii=False)


def _value(value: Any) -> str:
    if hasattr(value, "as_model"):
        value = value.as_model()
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(own)}" for key, own in value.items()) + " }"
    if isinstance(value, (Sequence, np.ndarray)):
        return "[" + ", ".join(_value(own) for own in value) + "]"
    raise TypeError(f"a scene cannot hold {type(value).__name__}: {value!r}")
