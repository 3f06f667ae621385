"""What goes wrong, and what is odd."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence
from typing import Any

_HERE = os.path.join(os.path.dirname(__file__), "")


class DashpotError(Exception):
    """What was asked for is not done.

    Attributes:
        faults: each with ``message``, ``help`` (what to do, or ``None``), ``file``, ``line`` and ``column`` (from 1,
            or ``None``).
    """

    def __init__(self, faults: Sequence[dict[str, Any]]) -> None:
        self.faults = list(faults)
        super().__init__("\n".join(_text(fault) for fault in self.faults) or "it failed")

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.faults,)


class SceneError(DashpotError, ValueError):
    """The input is wrong: a scene, a name, a value, a unit."""


class RunError(DashpotError, RuntimeError):
    """A run failed."""


class DashpotWarning(UserWarning):
    """What the reader of a result must know.

    Attributes:
        code: what it is, in a word that stays.
    """

    def __init__(self, text: str, code: str | None = None) -> None:
        super().__init__(text)
        self.code = code


def warn(text: str, code: str | None) -> None:
    """Warns at the line outside of the package that led to it."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_HERE):
        frame, level = frame.f_back, level + 1
    warnings.warn(DashpotWarning(text, code), stacklevel=level)


def _text(fault: dict[str, Any]) -> str:
    place = ""
    if fault.get("file") and fault.get("line"):
        place = f"{fault['file']}, line {fault['line']}: "
    help_ = f" (help: {fault['help']})" if fault.get("help") else ""
    return f"{place}{fault['message']}{help_}"
