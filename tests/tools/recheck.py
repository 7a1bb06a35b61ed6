"""A second checker, in another language and by itself: Python's fractions and nothing else.

    python3 recheck.py RESULT.json MODEL.json

RESULT is what `voussoir ... --save` wrote (version 3), MODEL what `voussoir check SCENE --json`
prints of the same scene: blocks with their masses and loads, contacts with points, frames and
friction. Every number is taken as the exact binary fraction that it is, and every sum is exact;
only square roots are bounded, on the safe side. Decided are verdicts, load factors, tilts and thrusts of scenes
whose joints have friction alone.

What is proved by forces: they balance every free block, and each lies in its friction cone. What
is proved by rates (velocities and spins of the blocks): no contact force inside its cone can have
negative power on them, so loads that gain power cannot be balanced (Kooharian 1952, Heyman 1966,
Livesley 1978: the static and the kinematic theorem). Numbers that are rounded leave a rest; what
is allowed of it stands at the top.

Prints `holds`, `refuted: why` or `not judged: why`; exit code 0, 1 or 3.
"""

import json
import sys
from fractions import Fraction as F

# What rounded forces may leave of a block's load. More: forces that balance nothing pass. Less:
# honest results are refused, whose forces are rounded to 16 digits and found to fewer.
BALANCE = F(1, 10**5)
# How far a force may lie beyond its cone, of its size. More: sliding passes for sticking.
CONE = F(1, 10**6)
# By how much a joint may close under rates, of the fastest block's speed. More: blocks pass
# through each other.
CLOSES = F(1, 10**9)
# Joints that slide open by no less than the friction times the way up to this, of that speed: what
# lies beside it is rounding of square roots.
OPENS = F(1, 10**6)
# Power that counts as gain, of the loads at the fastest block's speed. Less: rounding is a proof.
GAIN = F(1, 10**9)
# Numbers that are said agree with those found here to this share.
SAME = F(1, 10**5)


class Refuted(Exception):
    """Something that is said does not hold."""


class NotJudged(Exception):
    """Something that this program knows nothing of."""


# --- vectors --------------------------------------------------------------------------------------


def vec(v):
    return [F(x) for x in v]


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def mul(s, a):
    return [s * x for x in a]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def at_most(square):
    """A rational not below the square root of a rational, to about nine digits."""
    if square == 0:
        return F(0)
    scale = 1
    while square * scale * scale < 10**18:
        scale *= 10
    whole = square * scale * scale
    root = isqrt(whole.numerator // whole.denominator) + 1
    return F(root, scale)


def isqrt(n):
    x = n
    y = (x + 1) // 2
    while y < x:
        x, y = y, (y + n // y) // 2
    return x


def size(a):
    return at_most(dot(a, a))


# --- the scene ------------------------------------------------------------------------------------


class Scene:
    """Blocks and contacts, all numbers exact."""

    def __init__(self, model):
        if model["format"] != "voussoir-model/1":
            raise NotJudged("the model is of another version")
        if model.get("members"):
            raise NotJudged("members")
        self.index = {b["id"]: k for k, b in enumerate(model["blocks"])}
        self.blocks = model["blocks"]
        self.free = [k for k, b in enumerate(self.blocks) if not b["support"]]
        self.center = [vec(b["centroid"]) for b in self.blocks]
        self.dead = [(vec(b["dead"]["force"]), vec(b["dead"]["moment"])) for b in self.blocks]
        self.live = [(vec(b["live"]["force"]), vec(b["live"]["moment"])) for b in self.blocks]
        self.down = vec(model["gravity"])
        self.faces = [Face(f) for f in model["interfaces"]]

    def arm(self, k):
        """How far the contacts of a block are from its centre at most: what makes a moment a
        force."""
        own = [p for f in self.faces if k in f.between for p in f.points]
        return max([size(sub(p, self.center[k])) for p in own] or [F(1)])

    def turned(self, toward):
        """The loads of a tilt: own weight towards a direction across gravity."""
        length = size(self.down)
        down = [x / length for x in self.down]
        toward = vec(toward)
        if abs(dot(down, toward)) > F(1, 10**9) or abs(dot(toward, toward) - 1) > F(1, 10**9):
            raise Refuted("the direction of the tilt is no unit one across gravity")
        live = []
        for force, moment in self.dead:
            if any(moment):
                raise NotJudged("loads beside the centres of mass under a tilt")
            live.append((mul(dot(down, force), toward), [F(0)] * 3))
        self.live = live


class Face:
    """A contact: its two blocks, its points, its frame, its friction."""

    def __init__(self, face):
        for key in ("cohesion", "tension", "compression", "pore_pressure", "rolling_arm"):
            if face.get(key) not in (None, 0, "infinite" if key == "compression" else 0):
                raise NotJudged(f"joints with {key}")
        self.between = face["between"]
        self.points = [vec(p) for p in face["points"]]
        self.frame = [vec(face[k]) for k in ("t1", "t2", "n")]
        friction = face["friction"]
        self.friction = None if friction == "infinite" else F(friction)
        for k in range(3):
            a, b = self.frame[k], self.frame[(k + 1) % 3]
            if abs(dot(a, a) - 1) > F(1, 10**12) or abs(dot(a, b)) > F(1, 10**12):
                raise Refuted("the frame of a contact is none")


# --- evidence -------------------------------------------------------------------------------------


def read_forces(scene, certificate, key="forces"):
    """Force on the second block at every point of every contact; what is not said is nothing."""
    forces = [[[F(0)] * 3 for _ in f.points] for f in scene.faces]
    taken = set()
    for said in certificate[key]:
        if said.get("couples"):
            raise NotJudged("joints with couples")
        pair = [scene.index.get(b) for b in said["between"]]
        at = [vec(p) for p in said["points"]]
        own = [
            k
            for k, f in enumerate(scene.faces)
            if f.between == pair and k not in taken and same_points(f.points, at)
        ]
        if not own:
            raise Refuted(f"the scene has no contact {said['between']} at these points")
        taken.add(own[0])
        face = scene.faces[own[0]]
        for p, force in zip(at, said["forces"]):
            forces[own[0]][nearest(face.points, p)] = vec(force)
    return forces


def same_points(a, b):
    room = F(1, 10**6) * (1 + max(size(p) for p in a + b))
    near = all(min(size(sub(p, q)) for q in b) <= room for p in a)
    return len(a) == len(b) and near


def nearest(points, p):
    return min(range(len(points)), key=lambda k: dot(sub(points[k], p), sub(points[k], p)))


def read_rates(scene, certificate):
    """Velocity of the centre of mass and spin of every block; at most one unit fast."""
    rates = [([F(0)] * 3, [F(0)] * 3) for _ in scene.blocks]
    for said in certificate["rates"]:
        k = scene.index.get(said["block"])
        if k is None or scene.blocks[k]["support"]:
            raise Refuted(f"block {said['block']} cannot move")
        rates[k] = (vec(said["velocity"]), vec(said["spin"]))
    return rates


# --- the static side ------------------------------------------------------------------------------


def balanced(scene, forces, factor):
    """Forces in their cones that balance every free block under dead + factor x live loads."""
    rest = []
    for (dead, moment), (live, turning) in zip(scene.dead, scene.live):
        rest.append([add(dead, mul(factor, live)), add(moment, mul(factor, turning))])
    for face, list_ in zip(scene.faces, forces):
        for p, force in zip(face.points, list_):
            in_cone(face, force)
            for block, side in zip(face.between, (-1, 1)):
                own = mul(side, force)
                rest[block][0] = add(rest[block][0], own)
                arm = sub(p, scene.center[block])
                rest[block][1] = add(rest[block][1], cross(arm, own))
    for k in scene.free:
        force, moment = rest[k]
        own = size(scene.dead[k][0]) + abs(factor) * size(scene.live[k][0])
        carried = [size(f) for face, list_ in zip(scene.faces, forces) if k in face.between for f in list_]
        load = max([own] + carried)
        left = size(force) + size(moment) / scene.arm(k)
        if left > BALANCE * load:
            raise Refuted(f"{scene.blocks[k]['id']} is left with {float(left / load):.1e} of its load")


def in_cone(face, force):
    t1, t2, n = (dot(force, axis) for axis in face.frame)
    room = CONE * size(force)
    if n < -room:
        raise Refuted("a joint pulls")
    if face.friction is not None and size([t1, t2]) > face.friction * n + room:
        raise Refuted("a force lies outside its friction cone")


# --- the kinematic side ---------------------------------------------------------------------------


def admissible(scene, rates):
    """No force inside a cone has negative power on the rates: joints open by at least the friction
    times what they slide. Gives back the speed of the fastest block."""
    arms = [scene.arm(k) for k in range(len(scene.blocks))]
    speed = max([size(v) + size(w) * arms[k] for k, (v, w) in enumerate(rates)] or [F(0)])
    if speed == 0:
        raise Refuted("nothing moves")
    for face in scene.faces:
        for p in face.points:
            v = [
                add(rates[k][0], cross(rates[k][1], sub(p, scene.center[k]))) for k in face.between
            ]
            t1, t2, n = (dot(sub(v[1], v[0]), axis) for axis in face.frame)
            if n < -CLOSES * speed:
                raise Refuted("a joint closes")
            slides = size([t1, t2])
            # A joint that cannot slide at all carries any shear once it presses.
            if face.friction is None:
                if slides > OPENS * speed:
                    raise Refuted("a joint slides that cannot")
            elif n < face.friction * slides - OPENS * speed:
                raise Refuted("a joint slides without opening as it must")
    return speed


def power(loads, rates):
    return sum(dot(f, v) + dot(m, w) for (f, m), (v, w) in zip(loads, rates))


def scale(scene, speed):
    return speed * sum(size(scene.dead[k][0]) for k in scene.free)


# --- claims ---------------------------------------------------------------------------------------


def verdict(scene, standing, said):
    certificate = standing["certificate"]
    claim = certificate.get("claim")
    if claim != (None if said == "undecided" else said):
        raise Refuted(f"it is said to be {said}, claimed is {claim}")
    if claim in ("stable", "conditional"):
        balanced(scene, read_forces(scene, certificate), F(0))
    if claim == "unstable":
        rates = read_rates(scene, certificate)
        speed = admissible(scene, rates)
        if power(scene.dead, rates) < GAIN * scale(scene, speed):
            raise Refuted("the mechanism gains no power")
    if claim == "conditional":
        raise NotJudged("that self-stress is needed")


def factor(scene, evidence, said):
    """The bound on a load factor; gives back whether anything was decided."""
    bound, told = evidence["bound"], said["associative"]
    claim = bound.get("claim")
    if claim is None:
        if told["status"] != "undecided":
            raise Refuted("nothing is claimed of what is said")
        return
    if claim == "impossible":
        agree(told["status"], "impossible")
        rates = read_rates(scene, bound)
        speed = admissible(scene, rates)
        if power(scene.dead, rates) < GAIN * scale(scene, speed):
            raise Refuted("the mechanism gains no power under the dead load")
        if power(scene.live, rates) < -GAIN * scale(scene, speed):
            raise Refuted("the live load holds the mechanism back")
        return
    if "unbounded" in claim:
        agree(told["status"], "unbounded")
        balanced(scene, read_forces(scene, bound, "base"), F(claim["unbounded"]["standing"]))
        own, scene.dead = scene.dead, scene.live
        scene.live = [([F(0)] * 3, [F(0)] * 3) for _ in own]
        balanced(scene, read_forces(scene, bound), F(0))
        return
    value, lower, upper = (F(claim["load_factor"][k]) for k in ("value", "lower", "upper"))
    agree(told["status"], "found")
    for key, number in (("value", value), ("lower", lower), ("upper", upper)):
        close(F(told[key]), number, key)
    if not lower <= value <= upper:
        raise Refuted("the value is not in its bracket")
    balanced(scene, read_forces(scene, bound), lower)
    rates = read_rates(scene, bound)
    speed = admissible(scene, rates)
    driven = power(scene.live, rates)
    if driven <= 0:
        raise Refuted("the live load does not drive the mechanism")
    close(-power(scene.dead, rates) / driven, upper, "the bound by the mechanism")
    if upper - lower > 2 * SAME * max(abs(upper), scale(scene, speed) / driven):
        raise Refuted("the two sides do not meet")


def thrust(scene, evidence, question, said):
    if not question.get("support") or not question.get("direction"):
        raise NotJudged("the force in a member")
    support = scene.index[question["support"]]
    along = vec(question["direction"])
    for k, end in enumerate(("least", "greatest")):
        certificate, told = evidence["ends"][k], said[end]
        claim = certificate.get("claim")
        if claim is None or "thrust" not in claim:
            if told["status"] == "found":
                raise Refuted(f"nothing is claimed of the {end} thrust")
            continue
        if claim["thrust"]["extreme"] != end or claim["thrust"]["at"]["support"] != support:
            raise Refuted("another force is claimed")
        value = F(claim["thrust"]["value"])
        close(F(told["value"]), value, f"the {end} thrust")
        forces = read_forces(scene, certificate)
        balanced(scene, forces, F(0))
        pushed = sum(
            (1 if face.between[1] == support else -1) * dot(force, along)
            for face, list_ in zip(scene.faces, forces)
            if support in face.between
            for force in list_
        )
        close(pushed, value, f"the {end} thrust of the forces")
        # The support yields (is pushed in) at unit speed, and the blocks follow.
        sigma = 1 if end == "least" else -1
        rates = read_rates(scene, certificate)
        rates[support] = (mul(F(sigma), along), [F(0)] * 3)
        admissible(scene, rates)
        free = [(f, m) if j in scene.free else ([F(0)] * 3, [F(0)] * 3) for j, (f, m) in enumerate(scene.dead)]
        close(sigma * power(free, rates), value, f"the bound on the {end} thrust")


def agree(a, b):
    if a != b:
        raise Refuted(f"{a} is said, {b} is claimed")


def close(a, b, what):
    if abs(a - b) > SAME * max(abs(a), abs(b)) + F(1, 10**12):
        raise Refuted(f"{what}: {float(a)} and {float(b)}")


def judge(result, model):
    if result["format"] != "voussoir-result/3":
        raise NotJudged("the result is of another version")
    (kind, question), (of, evidence) = (next(iter(result[k].items())) for k in ("question", "evidence"))
    if kind != of:
        raise Refuted("the evidence is of another question")
    answer = result["answer"]
    if kind == "assess":
        verdict(Scene(model), evidence["standing"], answer["verdict"])
    elif kind == "limit":
        if evidence.get("dead"):
            verdict_or_not(Scene(model), evidence["dead"], answer["verdict"])
        factor(Scene(model), evidence["factor"], answer["load_factor"])
    elif kind == "tilt":
        if evidence.get("level"):
            verdict_or_not(Scene(model), evidence["level"], answer["verdict"])
        told = [d["answer"] for d in answer.get("directions", [{"answer": answer}])]
        if len(told) != len(evidence["directions"]):
            raise Refuted("a direction is missing")
        for own, said in zip(evidence["directions"], told):
            scene = Scene(model)
            scene.turned(said["toward"])
            factor(scene, own, said["tan_tilt"])
    elif kind == "thrust":
        if "thrust" in answer:
            said = answer.get("dead_load", {"answer": {"verdict": "undecided"}})
            verdict_or_not(Scene(model), evidence["standing"], said["answer"]["verdict"])
            thrust(Scene(model), evidence, question, answer["thrust"])
        else:
            verdict(Scene(model), evidence["standing"], answer["verdict"])
    else:
        raise NotJudged(f"`{kind}`")


def verdict_or_not(scene, standing, said):
    """That self-stress is needed is left aside beside a load factor."""
    try:
        verdict(scene, standing, said)
    except NotJudged:
        pass


def main(paths):
    result, model = (json.load(open(path, encoding="utf-8")) for path in paths)
    try:
        judge(result, model)
    except Refuted as why:
        print(f"refuted: {why}")
        return 1
    except NotJudged as why:
        print(f"not judged: {why}")
        return 3
    except (KeyError, TypeError, ValueError, IndexError, AttributeError, ZeroDivisionError) as why:
        print(f"refuted: it is no result: {why!r}")
        return 1
    print("holds")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
