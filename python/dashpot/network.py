"""Networks composed in Python: ``+`` puts models in series, ``|`` in parallel.

    from dashpot.network import Network, dashpot, spring

    network = Network("Head on a padded panel")
    network.mass("head", "10 kg", velocity="10 m/s")
    network.mass("panel", "100 kg")
    pad = spring("20 MN/m") + dashpot("6 kN s/m") + (spring("20 MN/m") | dashpot("4 kN s/m"))
    network.connect("padding", "head", "panel", pad, thickness="2 cm")
    network.connect("mount", "panel", "ground", spring("50 MN/m") | dashpot("10 kN s/m"))
    report = network.run("20 ms")

Quantities are texts with their unit, or numbers in SI units.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ._scene import Report, Scene


class Model:
    """A model with two ends: an element, or models in series or parallel. The first one is the impactor's side."""

    def __init__(self, law: str, of: Any, name: str | None = None) -> None:
        self.law, self.of, self.name = law, of, name

    def named(self, name: str) -> Model:
        """The same with a name, by which its parts are told: ``padding.<name>.peak-force``."""
        return Model(self.law, self.of, name)

    def __add__(self, other: Model) -> Model:
        return self._with("series", other)

    def __or__(self, other: Model) -> Model:
        return self._with("parallel", other)

    def _with(self, law: str, other: Model) -> Model:
        if not isinstance(other, Model):
            return NotImplemented
        parts = [part for own in (self, other) for part in (own.of if own._is_plain(law) else [own])]
        return Model(law, parts)

    def _is_plain(self, law: str) -> bool:
        return self.law == law and self.name is None

    def as_model(self) -> dict[str, Any]:
        """As a scene has it."""
        named = {} if self.name is None else {"name": self.name}
        return {self.law: self.of, **named}

    def __repr__(self) -> str:
        signs = {"series": " + ", "parallel": " | "}
        if self.law in signs:
            return "(" + signs[self.law].join(map(repr, self.of)) + ")"
        return f"{self.law}({self.of!r})"


def element(law: str, value: Any = None, /, **parameters: Any) -> Model:
    """An element, a named form or a composite of the scene format: ``element("power-spring", force="2 kN", …)``, or
    with its only parameter ``element("spring", "20 MN/m")``. Dashes in names of parameters are written ``_``.
    """
    own = {key.replace("_", "-"): of for key, of in parameters.items()}
    return Model(law, own if value is None else value)


def spring(stiffness: Any) -> Model:
    """A linear spring, F = k y, in N/m."""
    return element("spring", stiffness)


def dashpot(viscosity: Any) -> Model:
    """A linear dashpot, F = c y', in N s/m."""
    return element("dashpot", viscosity)


class Network:
    """Nodes along one axis, from the impactor towards the support, and what stands between them. The node ``ground``
    is there and never moves.
    """

    def __init__(self, title: str | None = None) -> None:
        self.title = title
        self.nodes: dict[str, dict[str, Any]] = {}
        self.elements: dict[str, dict[str, Any]] = {}
        self.effects: dict[str, Any] = {}
        self.measures: dict[str, Any] = {}
        self.limits: dict[str, Any] = {}
        self.duration: Any = "auto"

    def mass(self, name: str, mass: Any, **parameters: Any) -> str:
        """Adds a node of this mass in kg, with ``velocity`` in m/s or ``drop`` in m where it moves; its name."""
        self.nodes[name] = {"mass": mass, **parameters}
        return name

    def connect(self, name: str, a: str, b: str, model: Model, **parameters: Any) -> str:
        """Puts a model between two nodes, with ``thickness`` and ``area`` where they are known; its name."""
        own = {key.replace("_", "-"): of for key, of in parameters.items()}
        law = {key: of for key, of in model.as_model().items() if key != "name"}
        self.elements[name] = {"between": [a, b], **law, **own}
        return name

    def effect(self, name: str, **parameters: Any) -> None:
        """Turns an effect on, such as ``network.effect("gravity", value="1 g0")``; of one element
        ``network.effect("separation.pad")``."""
        place = self.effects
        *outer, last = name.split(".")
        for part in outer:
            place = place.setdefault(part, {})
        place[last] = {key.replace("_", "-"): of for key, of in parameters.items()}

    def as_scene(self) -> dict[str, Any]:
        """As a scene, of dictionaries."""
        sections: Mapping[str, Any] = {
            "nodes": self.nodes,
            "elements": self.elements,
            "effects": self.effects,
            "measures": self.measures,
            "limits": self.limits,
        }
        title = {} if self.title is None else {"title": self.title}
        filled = {key: own for key, own in sections.items() if own}
        return {**title, **filled, "run": {"duration": self.duration}}

    def scene(self, duration: Any = None) -> Scene:
        """The scene, which runs for ``duration`` in s, or as long as the impact lasts."""
        scene = self.as_scene()
        if duration is not None:
            scene["run"] = {"duration": duration}
        return Scene(scene)

    def run(self, duration: Any = None, method: str | None = None, **options: Any) -> Report:
        """Solves it; as `dashpot.run`."""
        return self.scene(duration).run(method, **options)
