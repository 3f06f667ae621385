"""Scenes from a seed: a text for the program, and the same as a network for the reference."""

import math
import re

import numpy as np

import laws
import waves
from bodies import Link, Network
from models import (
    Beside,
    Dice,
    Leaf,
    Row,
    Scales,
    contact,
    elastic,
    friction,
    kelvin,
    law,
    materials,
    maxwell,
    pulls,
    spring,
    table_loop,
    table_spring,
    zener,
    dashpot,
)
from rest import at_rest

G0 = 9.80665


class Scene:
    """Collects the text and the network."""

    def __init__(self, kind):
        self.kind = kind
        self.network = Network()
        self.network.node("ground", motion=waves.constant(0.0))
        self.nodes, self.elements, self.effects, self.loads, self.measured = [], [], [], [], {}
        self.places = {"ground": 0}
        self.masses, self.sliders, self.first, self.pulls, self.laws_of = [], {}, {}, {}, {}
        self.begins_at_rest, self.materials, self.touches = False, [], {}

    def node(self, name, mass=0.0, velocity=0.0, motion=None, drop=None):
        velocity = math.sqrt(2 * G0 * drop) if drop else velocity
        own = self.network.node(name, mass, velocity, motion)
        self.places[name] = own
        keys = [f"mass = {mass!r}"] if mass else []
        keys += [f"drop = {drop!r}"] if drop else [f"velocity = {velocity!r}"] if velocity else []
        keys += [f"{motion.word} = {{ {motion.text} }}"] if motion else []
        self.nodes.append(f"{name} = {{ {', '.join(keys)} }}")
        if mass:
            self.masses.append(own)
        return own

    def load(self, name, on, wave):
        self.network.nodes[self.places[on]].loads.append(wave)
        self.loads.append(f'{name} = {{ on = "{on}", force = {{ {wave.text} }} }}')

    def build(self, name, a, b, tree):
        """Links of a model; those whose forces make up that on its first end, with their parts of it."""
        if isinstance(tree, Leaf):
            if isinstance(tree.part, laws.Friction) and (a, b) in self.sliders:
                # Sliders side by side are one, of which each bears its part.
                at = self.sliders[a, b]
                self.network.links[at].part.strength += tree.part.strength
                return [(at, tree.part.strength)]
            self.network.links.append(Link(a, b, tree.part, name))
            at = len(self.network.links) - 1
            if isinstance(tree.part, laws.Friction):
                self.sliders[a, b] = at
                return [(at, tree.part.strength)]
            return [(at, None)]
        if isinstance(tree, Beside):
            return [own for one in tree.own for own in self.build(name, a, b, one)]
        ends = [a] + [self.network.node(f"{name}.joint-{i}") for i in range(1, len(tree.own))] + [b]
        found = [self.build(name, ends[i], ends[i + 1], one) for i, one in enumerate(tree.own)]
        return found[0]

    def element(self, name, a, b, tree, separation=None, face=None, stop=None):
        """`separation`: restitution; `face`: (mass, is struck); `stop`: (gap, e) or (gap, k, c)."""
        one, two = self.places[a], self.places[b]
        self.materials += materials(tree)
        self.laws_of[name] = tree.text
        self.elements.append(f'{name} = {{ between = ["{a}", "{b}"], {tree.text} }}')
        end = one
        if face is not None or separation is not None:
            mass = face[0] if face else 0.0
            start = self.network.nodes[one].velocity if face and not face[1] else 0.0
            end = self.network.node(f"{name}.face", mass, start)
            self.network.links.append(Link(one, end, laws.Contact(0.0, separation or 0.0), f"{name}.contact"))
            self.effects.append(f'separation.{name} = {{ at = "{a}", restitution = {separation or 0.0!r} }}')
            if face:
                touch = "impact" if face[1] else "moving"
                # A face that begins with the speed of what strikes is a part of that.
                if face[1]:
                    self.touches[name] = len(self.network.links) - 1
                self.effects.append(f'face.{name} = {{ mass = {mass!r}, touch = "{touch}" }}')
        force = self.build(name, end, two, tree)
        if stop:
            gap = stop[0]
            if len(stop) == 2:
                own = contact(gap, stop[1])
                words = f"restitution = {stop[1]!r}"
            else:
                own = Row(contact(gap), kelvin(stop[1], stop[2]))
                words = f"stiffness = {stop[1]!r}, damping = {stop[2]!r}"
            self.build(f"{name}.stop", end, two, own)
            self.effects.append(f"stop.{name} = {{ at = {gap!r}, {words} }}")
        self.measured[name], self.first[name] = (force, (end, two)), one
        self.pulls[name] = pulls(tree)

    def forces(self, name):
        force, ends = self.measured[name]
        links = self.network.links
        return [(at, 1.0 if own is None else own / links[at].part.strength) for at, own in force], ends

    def gravity(self, start="unloaded"):
        self.network.gravity = G0
        self.effects.append(f'gravity = {{ value = 9.80665, start = "{start}" }}')
        self.begins_at_rest = start == "equilibrium"

    def start(self):
        """Where all nodes begin."""
        if not self.begins_at_rest:
            return np.zeros(len(self.network.nodes))
        moving = {n for n in self.masses if self.network.nodes[n].velocity}
        struck = [
            (name, ends[0] if name in self.touches else ends[1])
            for name, (_, ends) in self.measured.items()
            if self.first[name] in moving
        ]
        return at_rest(self.network, struck)

    def is_impact(self, name):
        """Whether an impactor strikes it at the start."""
        first = self.network.nodes[self.first[name]]
        return first.mass > 0 and first.velocity > 0 and not re.search(r"gap = 0\.0*[1-9]", self.laws_of[name])

    def text(self, duration):
        lines = ["[materials]", *self.materials] if self.materials else []
        lines += ["[nodes]", *self.nodes, "[elements]", *self.elements]
        for head, own in (("effects", self.effects), ("loads", self.loads)):
            lines += [f"[{head}]", *own] if own else []
        return "\n".join(lines + ["[run]", f"duration = {duration!r}", ""])


def struck(dice):
    """A head, a pad, perhaps a panel on a mount, a second head, a guide, a stop, a face."""
    s = Scales(dice)
    scene = Scene("struck")
    r = lambda own: float(f"{own:.6g}")
    weight = dice.pick("", "", "", "unloaded", "equilibrium")
    if not weight and dice.chance(0.2):
        scene.node("head", r(s.m), drop=r(s.v**2 / 2 / G0))
    else:
        scene.node("head", r(s.m), r(s.v))
    below = "ground"
    if dice.chance(0.6):
        scene.node("panel", r(s.m * dice.spread(0.2, 5)))
        below = "panel"
    tree, keys = law(dice, s), {}
    if pulls(tree) and dice.chance(0.5):
        keys["separation"] = 0.0
        if dice.chance(0.3):
            keys["face"] = (r(s.m * dice.spread(0.02, 0.5)), dice.chance(0.5))
            keys["separation"] = dice.pick(0.0, dice.between(0, 0.8))
    if dice.chance(0.3):
        at = r(dice.between(0.3, 0.9) * s.y)
        soft = (at, r(dice.spread(3, 50) * s.k), r(dice.spread(0.02, 0.5) * s.c))
        keys["stop"] = (at, dice.pick(0.0, dice.between(0, 0.8))) if dice.chance(0.4) else soft
    scene.element("pad", "head", below, tree, **keys)
    if below == "panel":
        kinds = ("linear", "elastic") if weight == "equilibrium" else ("linear", "linear", "elastic", "slide", "rate")
        mount = law(dice, s, dice.pick(*kinds))
        scene.element("mount", "panel", "ground", mount)
        if dice.chance(0.4):
            scene.node("second", r(s.m * dice.spread(0.2, 3)), r(s.v * dice.between(0.2, 1.2)))
            more = {"separation": 0.0} if dice.chance(0.3) else {}
            kind = dice.pick("linear", "elastic") if more else dice.pick("linear", "elastic", "contact")
            scene.element("buffer", "second", "panel", law(dice, s, kind), **more)
    if weight:
        scene.gravity(weight)
    if weight != "equilibrium" and dice.chance(0.3):
        scene.element("guide", "head", "ground", friction(r(dice.spread(0.01, 0.2) * s.f)))
    if weight != "equilibrium" and dice.chance(0.2):
        scene.load("ram", below if below == "panel" else "head", pulse(dice, 0.5 * s.f, s.t))
    return scene, s, r(s.t * dice.between(0.8, 3.0))


def meeting(dice):
    """Masses that meet across gaps, with restitution."""
    s = Scales(dice)
    scene = Scene("meeting")
    r = lambda own: float(f"{own:.6g}")
    scene.node("head", r(s.m), r(s.v))
    scene.node("panel", r(s.m * dice.spread(0.1, 10)))
    e = dice.pick(0.0, 1.0, dice.between(0, 0.95))
    scene.element("bump", "head", "panel", contact(r(dice.between(0, 0.8) * s.y), e))
    scene.element("rail", "head", "ground", spring(r(0.1 * s.k)))
    scene.element("mount", "panel", "ground", law(dice, s, dice.pick("linear", "elastic", "rate")))
    if dice.chance(0.4):
        wall = Row(
            contact(r(dice.between(0.2, 1) * s.y)), kelvin(r(dice.spread(1, 10) * s.k), r(dice.spread(0.02, 0.4) * s.c))
        )
        scene.element("wall", "panel", "ground", wall)
    if dice.chance(0.3):
        scene.gravity()
    return scene, s, r(s.t * dice.between(1.0, 3.0))


def parcel(dice):
    """A box on a pad on a floor that throws it off."""
    s = Scales(dice)
    # The weight sags the pad by a part of what the floor moves.
    s.k = float(f"{dice.spread(3e3, 3e5):.6g}")
    s.v = float(f"{dice.between(1, 3) * G0 * math.sqrt(s.m / s.k):.6g}")
    s.set()
    scene = Scene("parcel")
    r = lambda own: float(f"{own:.6g}")
    t = s.t
    if dice.chance(0.5):
        frequency = r(dice.between(0.2, 0.7) / t)
        size = r(G0 * dice.between(0.7, 2) / (2 * math.pi * frequency) ** 2)
        motion = waves.sine(size, frequency, 0.0)
    else:
        motion = waves.accelerated(
            r(-G0 * dice.between(1, 6)), r(t * dice.between(0.3, 1.5)), r(t * dice.between(0, 0.3))
        )
    scene.node("floor", motion=motion)
    scene.node("box", r(s.m))
    c = r(dice.spread(0.03, 0.4) * s.c)
    tree = dice.pick(kelvin(r(s.k), c), zener(r(s.k), r(2 * s.k), c), Beside(elastic(dice, s), dashpot(c)))
    more = {"separation": 0.0} if dice.chance(0.7) else {}
    scene.element("pad", "box", "floor", tree, **more)
    if dice.chance(0.4):
        scene.node("item", r(s.m * dice.spread(0.1, 0.8)))
        scene.element("wrap", "item", "box", kelvin(r(s.k), c))
    scene.gravity("equilibrium")
    return scene, s, r(t * dice.between(1.5, 4))


def pulse(dice, size, t):
    r = lambda own: float(f"{own:.6g}")
    word = dice.pick("constant", "ramp", "sine", "half-sine", "haversine", "trapezoid", "chirp", "table")
    size, start = r(size * dice.between(0.2, 1)), r(t * dice.between(0, 0.5))
    if word == "constant":
        return waves.constant(size, start)
    if word == "ramp":
        return waves.ramp(size, r(t * dice.between(0.1, 1)), start)
    if word == "sine":
        return waves.sine(size, r(dice.between(0.2, 2) / t), dice.between(0, 6))
    if word == "half-sine":
        return waves.half_sine(size, r(t * dice.between(0.3, 1)), start)
    if word == "haversine":
        return waves.haversine(size, r(t * dice.between(0.3, 1)), start)
    if word == "trapezoid":
        a, b, c = (r(t * dice.between(0.1, 0.5)) for _ in range(3))
        return waves.trapezoid(size, a, b, c, start)
    if word == "chirp":
        return waves.chirp(
            size, r(dice.between(0.1, 0.5) / t), r(dice.between(0.5, 2) / t), r(t * dice.between(0.5, 2))
        )
    places = sorted(r(t * dice.between(0, 2)) for _ in range(4))
    return waves.table([(0.0, 0.0)] + [(own, r(size * dice.between(-1, 1))) for own in places])


def driven(dice):
    """A mass, perhaps two, on a floor that moves."""
    s = Scales(dice)
    scene = Scene("driven")
    r = lambda own: float(f"{own:.6g}")
    size = s.y * dice.between(0.3, 1.5)
    word = dice.pick("sine", "haversine", "half-sine", "ramp", "chirp")
    t = s.t
    if word == "sine":
        motion = waves.sine(r(size), r(dice.between(0.15, 1) / t), 0.0)
    elif word == "haversine":
        motion = waves.haversine(r(size), r(t * dice.between(0.5, 2)), r(t * dice.between(0, 0.3)))
    elif word == "half-sine":
        motion = waves.half_sine(r(size), r(t * dice.between(0.5, 2)), r(t * dice.between(0, 0.3)))
    elif word == "ramp":
        motion = waves.ramp(r(size), r(t * dice.between(0.2, 1)), r(t * dice.between(0, 0.3)))
    else:
        motion = waves.chirp(r(size), r(0.1 / t), r(dice.between(0.3, 1) / t), r(t * dice.between(1, 2)))
    scene.node("floor", motion=motion)
    scene.node("box", r(s.m))
    kind = dice.pick("linear", "elastic", "slide", "rate", "row", "gap")
    keys = {}
    if dice.chance(0.4):
        keys["stop"] = (r(dice.between(0.2, 0.8) * s.y), r(dice.spread(3, 30) * s.k), r(dice.spread(0.02, 0.5) * s.c))
    # Compression counts positive: the floor pushes the box.
    scene.element("mount", "floor", "box", law(dice, s, kind), **keys)
    if dice.chance(0.5):
        scene.node("item", r(s.m * dice.spread(0.1, 0.8)))
        scene.element("wrap", "box", "item", law(dice, s, dice.pick("linear", "elastic", "slide", "contact")))
        if isinstance(scene.network.links[-1].part, (laws.HuntCrossley, laws.Hysteretic)) or dice.chance(0.3):
            scene.element("tie", "item", "ground", kelvin(r(0.1 * s.k), r(0.02 * s.c)))
    if dice.chance(0.3):
        scene.element("rail", "box", "ground", friction(r(dice.spread(0.01, 0.3) * s.f)))
    if dice.chance(0.3):
        scene.load("ram", "box", pulse(dice, 0.5 * s.f, s.t))
    if dice.chance(0.2):
        scene.gravity()
    return scene, s, r(s.t * dice.between(1.0, 3.5))


def equal(dice):
    """Masses, links or branches that are alike, so that eigenvalues coincide or their differences vanish."""
    s = Scales(dice)
    scene = Scene("equal")
    r = lambda own: float(f"{own:.6g}")
    m, v = r(s.m), r(s.v)
    word = dice.pick("pair", "pair", "row", "ratios", "twins", "branches", "wall")
    kinds = ("linear", "elastic", "contact", "rate")
    first = dice.pick(lambda: law(dice, s, dice.pick(*kinds)), lambda: elastic(dice, s), lambda: spring(r(s.k)))()
    scene.node("head", m, v)
    apart = {"separation": 0.0} if pulls(first) and dice.chance(0.5) else {}
    if word in ("pair", "wall"):
        scene.node("panel", m)
        scene.element("pad", "head", "panel", first, **apart)
        if word == "wall":
            gap = r(dice.between(0.1, 1) * s.y)
            scene.element("bump", "panel", "ground", Row(contact(gap), kelvin(r(3 * s.k), r(0.05 * s.c))))
    elif word in ("row", "ratios"):
        masses = [m, r(2 * m)] if word == "ratios" else [m] * dice.pick(2, 3, 4)
        link = dice.pick(spring(r(s.k)), kelvin(r(s.k), r(0.1 * s.c)), elastic(dice, s))
        before = "head"
        for at, own in enumerate(masses):
            scene.node(f"wagon-{at}", own)
            scene.element(f"link-{at}", before, f"wagon-{at}", first if at == 0 else link, **(apart if at == 0 else {}))
            before = f"wagon-{at}"
        if dice.chance(0.5):
            scene.element("buffer", before, "ground", link)
    elif word == "twins":
        # Two alike on the struck mass: one of their modes is never excited.
        scene.element("pad", "head", "ground", first, **apart)
        branch = dice.pick(spring(r(s.k)), kelvin(r(s.k), r(0.1 * s.c)), elastic(dice, s))
        for name in ("left", "right"):
            scene.node(name, r(0.5 * m), v)
            scene.element(f"arm-{name}", "head", name, branch)
    else:
        k, c, n = r(s.k), r(dice.spread(0.1, 0.6) * s.c), dice.pick(2, 3)
        branch = dice.pick(maxwell(k, c), Row(*[kelvin(r(n * s.k), c)] * n), zener(k, k, c))
        scene.element("pad", "head", "ground", Beside(spring(k), *[branch] * n), **apart)
    return scene, s, r(s.t * dice.between(0.8, 3.0))


def curves(dice):
    """A head on a pad of measured points, few or many, on a straight line or on a bent one."""
    s = Scales(dice)
    scene = Scene("curves")
    r = lambda own: float(f"{own:.6g}")
    scene.node("head", r(s.m), r(s.v))
    depth, power = 2.5 * s.y, dice.pick(1.0, dice.between(1.1, 2.5))

    def load(y):
        return 1.5 * s.f * (y / depth) ** power

    def points(count, first, of):
        inner = sorted(dice.between(first + 0.02 * depth, 0.98 * depth) for _ in range(count - 2))
        spread = [first] + [own for a, own in zip([first, *inner], inner) if own - a > 0.01 * depth] + [depth]
        return [(r(own), r(of(own))) for own in spread]

    loading = points(dice.pick(2, 2, 3, 5, 12, 30), 0.0, load)
    if dice.chance(0.5):
        below = points(dice.pick(2, 3, 6), 0.0, lambda y: 1.2 * load(y))[1:]
        own = [(-y, -f) for y, f in reversed(below)] + loading
        scene.element("pad", "head", "ground", table_spring(own, r(dice.spread(0.02, 0.3) * s.c)), separation=0.0)
    else:
        rest, bend = dice.between(0.05, 0.3) * depth, dice.pick(1.0, dice.between(1, 2))
        back = points(dice.pick(2, 2, 3, 8), rest, lambda y: load(depth) * ((y - rest) / (depth - rest)) ** bend)
        scene.element("pad", "head", "ground", table_loop(loading, back))
    return scene, s, r(s.t * dice.between(1.0, 3.0))


def humps(dice):
    """A head in a box that is pushed several times, of nearly equal size."""
    s = Scales(dice)
    scene = Scene("humps")
    r = lambda own: float(f"{own:.6g}")
    scene.node("head", r(s.m))
    scene.node("box", r(s.m * dice.spread(0.5, 4)))
    scene.element("wrap", "head", "box", law(dice, s, dice.pick("linear", "linear", "elastic", "rate")))
    scene.element("mount", "box", "ground", kelvin(r(0.3 * s.k), r(dice.spread(0.05, 0.4) * s.c)))
    start = 0.0
    for at in range(dice.pick(2, 2, 3, 4)):
        wave = dice.pick(waves.half_sine, waves.haversine)
        length = s.t * dice.between(0.3, 1.2)
        scene.load(f"push-{at}", "box", wave(r(-s.f * dice.between(0.85, 1.0)), r(length), r(start)))
        start += length * dice.between(0.6, 1.8)
    return scene, s, r(start + s.t * dice.between(0.3, 1.0))


# Seeds from here on draw those kinds that came later: others keep their scenes.
LATER = 100_000


def draw(seed):
    dice = Dice(seed)
    if seed >= LATER:
        return dice.pick(equal, curves, humps)(dice)
    return dice.pick(struck, struck, struck, driven, driven, meeting, parcel)(dice)
