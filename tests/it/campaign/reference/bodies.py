"""Bodies: what rigid links, closed contacts and stuck sliders join."""

import numpy as np


class Unfit(Exception):
    """The scene is no fair test: what happens in it is a matter of convention, or beyond rounding."""


class Node:
    def __init__(self, name, mass=0.0, velocity=0.0, motion=None, load=None):
        self.name, self.mass, self.velocity, self.motion = name, mass, velocity, motion
        self.loads = [load] if load else []


class Link:
    """A part between two nodes, by number."""

    def __init__(self, a, b, part, name):
        self.a, self.b, self.part, self.name = a, b, part, name


class Network:
    def __init__(self, gravity=0.0):
        self.nodes, self.links, self.gravity = [], [], gravity

    def node(self, *args, **keys):
        self.nodes.append(Node(*args, **keys))
        return len(self.nodes) - 1


class Mode:
    """Bodies and fixed offsets of one combination of phases."""

    def __init__(self, network, phases, x):
        self.network, self.phases = network, phases
        count = len(network.nodes)
        self.body = list(range(count))
        self.tree = [[] for _ in range(count)]
        self.constraints = []
        held = [(at, link, link.part.held(phase)) for at, (link, phase) in enumerate(zip(network.links, phases))]
        offset = [0.0] * count
        for at, link, level in held:
            if level is None:
                continue
            a, b = self.body[link.a], self.body[link.b]
            if a == b:
                raise Unfit("a loop of constraints")
            shift = offset[link.b] + level - offset[link.a]
            for n in range(count):
                if self.body[n] == a:
                    self.body[n], offset[n] = b, offset[n] + shift
            self.tree[link.a].append((link.b, at))
            self.tree[link.b].append((link.a, at))
            self.constraints.append(at)
        self.offset = offset
        self.root, self.mass, self.given = {}, {}, {}
        for b in set(self.body):
            own = [n for n in range(count) if self.body[n] == b]
            moved = [n for n in own if network.nodes[n].motion is not None]
            heavy = [n for n in own if network.nodes[n].mass > 0]
            if len(moved) > 1:
                raise Unfit("two given places are joined")
            self.given[b] = moved[0] if moved else None
            self.mass[b] = sum(network.nodes[n].mass for n in own)
            self.root[b] = (moved or heavy or own)[0]
        self.free = [b for b in sorted(set(self.body)) if self.given[b] is None]
        self.index = {b: i for i, b in enumerate(self.free)}
        self.heavy = np.array([self.mass[b] > 0 for b in self.free], bool)
        self.masses = np.array([self.mass[b] for b in self.free])
        self.sides = {at: self.side(at) for at in self.constraints}
        self.laws = [at for at, _, level in held if level is None]
        self.map = np.array([self.index.get(b, -1) for b in self.body])

    def has_idle_slider(self):
        """Whether a slider lies beside what holds its ends, so that its force follows from nothing."""
        links = (self.network.links[at] for at in self.laws)
        return any(hasattr(own.part, "strength") and self.body[own.a] == self.body[own.b] for own in links)

    def side(self, at):
        """The nodes on one side of a constraint, without a given place, and whether it is side a."""
        for first, is_a in ((self.network.links[at].a, True), (self.network.links[at].b, False)):
            found, todo = {first}, [first]
            while todo:
                for other, by in self.tree[todo.pop()]:
                    if by != at and other not in found:
                        found.add(other)
                        todo.append(other)
            if not any(self.network.nodes[n].motion is not None for n in found):
                return sorted(found), is_a
        raise Unfit("a constraint between given places")
