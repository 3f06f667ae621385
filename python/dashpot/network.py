"""Networks composed in Python: ``+`` puts models in series, ``|`` in parallel.

    from dashpot.network import Network, dashpot, spring

    network = Network("Head on a padded panel")
    network.mass("head", "10 kg", velocity="10 m/s")
    network.mass("panel", "100 kg")
    pad = spring("20 MN/m") + dashpot("6 kN s/m") + (spring("20 MN/m") | dashpot("4 kN s/m"))
    network.connect("padding", "head", "panel", pad, thickness="2 cm")
    network.connect("mount", "panel", "ground", spring("50 MN/m") | dashpot("10 kN s/m"))
    report = network.run("20 ms")

Quantities are texts with their unit, or numbers in SI units. Dashes in names of parameters are written ``_``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ._scene import Report, Scene


class Model:
    """A model with two ends: an element, or models in series or parallel. The first one is the impactor's side."""

    def __init__(
        self, law: str, of: Any, name: str | None = None, beside: Mapping[str, Any] | None = None
    ) -> None:
        self.law, self.of, self.name = law, of, name
        self.beside = dict(beside or {})

    def named(self, name: str) -> Model:
        """The same with a name, by which its parts are told: ``padding.<name>.spring``."""
        return Model(self.law, self.of, name, self.beside)

    def having(self, **beside: Any) -> Model:
        """The same with what stands beside its law: ``thickness``, ``area`` or ``pressed_by`` of a material, or a
        ``shift`` of its times."""
        return Model(self.law, self.of, self.name, {**self.beside, **_dashed(beside)})

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
        return self.law == law and self.name is None and not self.beside

    def as_model(self) -> dict[str, Any]:
        """As a scene has it."""
        named = {} if self.name is None else {"name": self.name}
        return {self.law: self.of, **self.beside, **named}

    def as_law(self) -> dict[str, Any]:
        """As it is the law of an element or of a model in a scene, where a name stands at a branch only."""
        return self.as_model() if self.name is None else {"series": [self]}

    def __repr__(self) -> str:
        signs = {"series": " + ", "parallel": " | "}
        if self.law in signs:
            shown = "(" + signs[self.law].join(map(repr, self.of)) + ")"
        else:
            shown = f"{self.law}({self.of!r})"
        having = ", ".join(f"{key.replace('-', '_')}={own!r}" for key, own in self.beside.items())
        shown += f".having({having})" if having else ""
        return shown if self.name is None else f"{shown}.named({self.name!r})"


def element(law: str, value: Any = None, /, **parameters: Any) -> Model:
    """An element, a named form or a composite of the scene format: ``element("power-spring", force="2 kN", …)``, or
    with its only parameter ``element("spring", "20 MN/m")``; ``element("model", "felt")`` is a model by its name.
    """
    return Model(law, _dashed(parameters) if value is None else value)


def spring(stiffness: Any) -> Model:
    """A linear spring, F = k y, in N/m."""
    return element("spring", stiffness)


def dashpot(viscosity: Any) -> Model:
    """A linear dashpot, F = c y', in N s/m."""
    return element("dashpot", viscosity)


def material(name: str, **beside: Any) -> Model:
    """A pad of a material of the network, by its name, with ``thickness`` in m and ``area`` in m² where the element
    does not say them."""
    return element("material", name).having(**beside)


class Network:
    """Nodes along one axis, from the impactor towards the support, and what stands between them. The node ``ground``
    is there and never moves.

    Its sections are dictionaries of the shape of the scene format, which its methods fill: ``values``, ``models``,
    ``materials``, ``nodes``, ``elements``, ``effects``, ``loads``, ``measures``, ``limits``, ``accuracy`` and
    ``settings``, which is ``[run]`` with ``duration``.
    """

    def __init__(self, title: str | None = None) -> None:
        self.title = title
        self.values: dict[str, Any] = {}
        self.models: dict[str, Any] = {}
        self.materials: dict[str, Any] = {}
        self.nodes: dict[str, dict[str, Any]] = {}
        self.elements: dict[str, dict[str, Any]] = {}
        self.effects: dict[str, Any] = {}
        self.loads: dict[str, Any] = {}
        self.measures: dict[str, Any] = {}
        self.limits: dict[str, Any] = {}
        self.accuracy: dict[str, Any] = {}
        self.settings: dict[str, Any] = {"duration": "auto"}

    def value(self, name: str, value: Any) -> str:
        """Names a quantity, which may then stand wherever one may: ``spring(network.value("K", "20 MN/m"))``, and is
        varied by its name; the name."""
        return _added(self.values, name, value)

    def model(self, name: str, model: Model) -> Model:
        """Names a model for several places, for which what is returned stands."""
        _added(self.models, name, model.as_law())
        return element("model", name)

    def material(self, name: str, law: Model) -> Model:
        """Names a material, whose law is a model with stresses in Pa for forces and strains for lengths:
        ``spring("0.8 MPa")``; a pad of it, which `Model.having` or `connect` gives ``thickness`` and ``area``."""
        _added(self.materials, name, law.as_law())
        return material(name)

    def node(self, name: str, **parameters: Any) -> str:
        """Adds a node: without mass, or with ``fixed=True``, or with a ``motion``, ``velocity`` or ``acceleration``
        over time, such as ``motion={"sine": {"amplitude": "1 mm", "frequency": "25 Hz"}}``; its name."""
        return _added(self.nodes, name, _dashed(parameters))

    def mass(self, name: str, mass: Any, **parameters: Any) -> str:
        """Adds a node of this mass in kg, with ``velocity`` in m/s or ``drop`` in m where it moves; its name."""
        return self.node(name, mass=mass, **parameters)

    def connect(self, name: str, a: str, b: str, model: Model, **parameters: Any) -> str:
        """Puts a model between two nodes, with ``thickness`` and ``area`` where they are known; its name."""
        return _added(self.elements, name, {"between": [a, b], **model.as_law(), **_dashed(parameters)})

    def effect(self, name: str, **parameters: Any) -> None:
        """Turns an effect on, such as ``network.effect("gravity", value="1 g0")``; of one element
        ``network.effect("separation.pad")``."""
        place = self.effects
        *outer, last = name.split(".", 1)
        for part in outer:
            place = place.setdefault(part, {})
        place[last] = _dashed(parameters)

    def load(self, name: str, on: str, force: Any) -> str:
        """Puts a force on a node, in N and positive towards the support: ``{"half-sine": {"peak": "2 kN", …}}`` or
        another function of time; its name."""
        return _added(self.loads, name, {"on": on, "force": force})

    def measure(self, of: str, kind: str, **parameters: Any) -> None:
        """Asks for a measure of a node or an element: ``network.measure("head", "hic15")``."""
        own = {"kind": kind, **_dashed(parameters)} if parameters else kind
        self.measures.setdefault(of, []).append(own)

    def limit(self, key: str, most: Any = None, **parameters: Any) -> None:
        """What a measure may be: at most this, or with ``max``, ``min`` and ``from_``, which says where that is from:
        ``network.limit("head.peak-acceleration", "250 g")``."""
        own = {name.rstrip("-"): of for name, of in _dashed(parameters).items()}
        self.limits[key] = most if most is not None else own

    def as_scene(self) -> dict[str, Any]:
        """As a scene, of dictionaries."""
        names = ("values", "models", "materials", "nodes", "elements", "effects", "loads")
        names += ("measures", "limits", "accuracy")
        title = {} if self.title is None else {"title": self.title}
        filled = {name: getattr(self, name) for name in names if getattr(self, name)}
        return {**title, **filled, "run": dict(self.settings)}

    def scene(self, duration: Any = None) -> Scene:
        """The scene, which runs for ``duration`` in s, or as long as the impact lasts."""
        scene = self.as_scene()
        if duration is not None:
            scene["run"]["duration"] = duration
        return Scene(scene)

    def run(self, duration: Any = None, method: str | None = None, **options: Any) -> Report:
        """Solves it; as `dashpot.run`."""
        return self.scene(duration).run(method, **options)


def _dashed(parameters: Mapping[str, Any]) -> dict[str, Any]:
    return {key.replace("_", "-"): of for key, of in parameters.items()}


def _added(section: dict[str, Any], name: str, own: Any) -> str:
    # In place of another one it would change what is there already.
    if name in section:
        raise ValueError(f"there is a {name!r} already")
    section[name] = own
    return name
