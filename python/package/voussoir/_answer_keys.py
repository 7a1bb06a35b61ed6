"""The keys of answers. Made by ``python/generate.py`` from ``voussoir schema``: not to be edited."""

from __future__ import annotations

from typing import Any, Literal

from ._record import Keys, Number, Record, Verdict, field

__all__ = [
    "Agreement",
    "AssessmentKeys",
    "AxleOnSpan",
    "BlockMotion",
    "Bound",
    "Bracket",
    "Bracketed",
    "Capacity",
    "Check",
    "CombinationsKeys",
    "Control",
    "CriticalResult",
    "CriticalValue",
    "CurvePoint",
    "Deciding",
    "Demand",
    "Derivative",
    "Displacement",
    "Doubt",
    "Event",
    "FlipResult",
    "ForceAgreement",
    "GeometricFactor",
    "Given",
    "Greatest",
    "HeldForce",
    "Hinge",
    "InCombination",
    "JointMotion",
    "JointState",
    "KinematicKeys",
    "LeastMargin",
    "LimitKeys",
    "LimitState",
    "LoadFactor",
    "MaterialFactors",
    "Mechanism",
    "MeetChange",
    "MeetKeys",
    "MeetPoint",
    "MemberLine",
    "MemberMotion",
    "MovingKeys",
    "Nested",
    "Note",
    "Numbers",
    "Order",
    "PairForce",
    "Participation",
    "PathAnswer",
    "PathEvent",
    "PathFactor",
    "PathKeys",
    "PathPoint",
    "PathResult",
    "Placed",
    "Reaction",
    "Required",
    "Residuals",
    "Run",
    "ScanPoint",
    "Sensitivity",
    "Series",
    "ShakeOptions",
    "ShakenBlock",
    "ShakenKeys",
    "Share",
    "Side",
    "Simulated",
    "SimulationKeys",
    "Slip",
    "StageReaction",
    "StageResult",
    "StagesKeys",
    "StagesResult",
    "StateKeys",
    "States",
    "ThrustKeys",
    "ThrustLine",
    "ThrustResult",
    "ThrustSection",
    "TiltKeys",
    "Watched",
    "Why",
    "WithoutBlock",
    "WithoutKeys",
]


class Bracket(Record):
    """Two ends that enclose a value.

    Attributes
    ----------
    lower : float or None
        Lower end.
    upper : float or None
        Upper end.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> error = voussoir.assess(table).equilibrium_error
    >>> error.lower, error.upper < 1e-9
    (0.0, True)
    """

    lower: float | None
    upper: float | None


class Deciding(Record):
    """The part of a scene that decided an answer, where there are several.

    Attributes
    ----------
    first : str
        Its first free block.
    blocks : int
        How many free blocks it has.
    of_blocks : int
        How many free blocks the scene has.
    of_parts : int
        How many parts the scene has.
    """

    first: str
    blocks: int
    of_blocks: int
    of_parts: int


class LoadFactor(Number):
    """A load factor, or a tilt: the one to use, and the bound beside it under its own name.

    Attributes
    ----------
    status : {"found", "unbounded", "impossible", "at_least", "not_at_rest", "undecided"}
        What became of it.

        * ``found``: There is a value.
        * ``unbounded``: There is no limit.
        * ``impossible``: No load factor lets the scene stand.
        * ``at_least``: It is not less than ``lower``, which another answer is known to bear;
          how much more was not asked.
        * ``not_at_rest``: Under the dead load alone it does not come to rest: there is no value
          with dry friction. It falls where the bound is below zero, and needs self-stress
          otherwise.
        * ``undecided``: It did not come out.

    law : {"associative", "coulomb"}
        The law of sliding that it holds for.

        * ``associative``: A joint that slides opens by μ × the slip. Admissible forces are then
          enough to stand.
        * ``coulomb``: Dry friction: a joint slides without opening. Forces must also be such as
          the loads produce.

    value : float or None
        The value to use; absent where none was found.
    lower : float or None
        Lower end of its bracket. With dry friction that slides it is computed: up to there the
        state was seen at rest.
    upper : float or None
        Upper end of its bracket. With dry friction that slides the least value at which the
        state was seen to move, or else the proved bound.
    found : {"nothing_slides", "fixed_point", "unlimited", "rests", "rests_below", "at_least", "not_at_rest", "undecided"} or None
        How the value with dry friction was found, where that was asked.

        * ``nothing_slides``: The associative mechanism slides nowhere.
        * ``fixed_point``: A fixed point on the friction limits.
        * ``unlimited``: The live load alone comes to rest on forces that it produces itself: no
          limit. Computed, not proved.
        * ``rests``: The state under dry friction rests up to the value, and no longer somewhat
          above it. Computed, not proved.
        * ``rests_below``: The state under dry friction rests up to the value; what it does from
          there to where it moves, or else to the bound, little more, did not come out, or was not
          asked of many blocks. Computed, not proved.
        * ``at_least``: The state under dry friction rests at a load factor that was asked for,
          because another answer is no higher: there is no value, only that it is not less.
          Computed, not proved.
        * ``not_at_rest``: Already under the dead load the state does not rest: it needs self-
          stress, or falls, which a bound below zero proves. There is no value.
        * ``undecided``: It did not settle: there is no value.

    associative : Bound
        The bound: joints that slide open as well.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.limit(table.load("live", weight=(1, 0, 0)))
    >>> factor = answer.load_factor
    >>> factor.status, factor.law, round(factor.value, 6), factor.lower <= factor.upper
    ('found', 'coulomb', 0.4, True)
    >>> round(float(factor), 6), factor["status"]
    (0.4, 'found')
    """

    status: Literal["found", "unbounded", "impossible", "at_least", "not_at_rest", "undecided"]
    law: Literal["associative", "coulomb"]
    value: float | None
    lower: float | None
    upper: float | None
    found: Literal["nothing_slides", "fixed_point", "unlimited", "rests", "rests_below", "at_least", "not_at_rest", "undecided"] | None
    associative: Bound


class Bound(Number):
    """A value that is proved on both sides: the bound on a load factor, an end of the range
    of a thrust or of a member's force, N.

    Attributes
    ----------
    status : {"found", "unbounded", "impossible", "undecided"}
        What became of it.

        * ``found``: The greatest load factor, in a narrow bracket.
        * ``unbounded``: The live load can grow without limit: contact forces balance it by
          themselves (wedged).
        * ``impossible``: No multiple of the live load lets the scene stand.
        * ``undecided``: The bracket did not close.

    value : float or None
        The value, where found.
    lower : float or None
        Lower end of its bracket.
    upper : float or None
        Upper end of its bracket.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.limit(table.load("live", weight=(1, 0, 0)))
    >>> bound = answer.load_factor.associative
    >>> bound.status, bound.lower <= bound.value <= bound.upper
    ('found', True)
    """

    status: Literal["found", "unbounded", "impossible", "undecided"]
    value: float | None
    lower: float | None
    upper: float | None


class AxleOnSpan(Record):
    """An axle where it stands.

    Attributes
    ----------
    axle : int
        Its place in the list of axles, from 0.
    x : float
        Where it stands, x in the scene, m.
    force : float
        Its force, N.
    share : float
        The share of it that presses on the spans; the rest presses beside them and is left out.
    """

    axle: int
    x: float
    force: float
    share: float


class GeometricFactor(Record):
    """A geometric safety factor.

    Attributes
    ----------
    value : float or None
        The factor, where there is one; it is beyond ``lower`` otherwise.
    lower : float
        With sections shrunk by this it stands.
    upper : float or None
        With sections shrunk by this it falls.
    """

    value: float | None
    lower: float
    upper: float | None


class Bracketed(Record):
    """A value between two proved ends.

    Attributes
    ----------
    value : float
        The value.
    lower : float
        Lower end.
    upper : float
        Upper end.
    """

    value: float
    lower: float
    upper: float


class Control(Record):
    """A control point.

    Attributes
    ----------
    block : str
        The block.
    point : three numbers
        The point of it at the start, m.
    """

    block: str
    point: tuple[float, float, float]


class PathAnswer(Record):
    """How far it goes.

    Attributes
    ----------
    status : {"reached", "falls", "vanishes", "slides", "open"}
        How it ends.

        * ``reached``: All of the movement was followed: it stands to its end.
        * ``falls``: It falls on the way.
        * ``vanishes``: The load factor vanishes: beyond it would have to be pulled back.
        * ``slides``: A joint slides from here on, and no motion under dry friction was found
          that leads on.
        * ``open``: It was not followed any further.

    value : float or None
        The last value of the parameter that is proved: it stands there, or has the load factor
        of the last point. Settle: a share of the movement; push: the way of the control point,
        m. Absent where nothing is proved.
    falls_at : float or None
        It falls: at this value it is proved to.
    jumps_at : float or None
        It jumps here first: the motion turns back, and what is told of beyond is what it may
        come to by a motion that is not followed.
    least_reaction : Bracketed or None
        Settle: the least power that the blocks' forces on the supports can have at the start as
        these begin to move, J per unit of the parameter. Where one support moves straight by 1
        m it is its least reaction in that direction, N.
    """

    status: Literal["reached", "falls", "vanishes", "slides", "open"]
    value: float | None
    falls_at: float | None
    jumps_at: float | None
    least_reaction: Bracketed | None


class Numbers(Record):
    """What follows from a mechanism, its curve and the site.

    Attributes
    ----------
    a0 : float or None
        a0 = α0 g / (e* FC), m/s²; absent where α0 was not found.
    a0_of_bodies : float or None
        The same with blocks that move as one counted as one, where that is less.
    participation : Participation or None
        What of the mass takes part: e*, M* and δ of every mass that moves.
    unique : {"only", "one_of_several", "unknown"} or None
        Whether the joints that the mechanism keeps closed allow another one.

        * ``only``: The joints that it keeps closed allow no other.
        * ``one_of_several``: They allow others, which start at the same load factor.
        * ``unknown``: Too many bodies move to tell.

    control_delta : float or None
        δ of the control point, in the measure of the masses' δ.
    capacity : Capacity or None
        What the curve gives, where it vanishes.
    demand : Demand or None
        What the site demands.
    """

    a0: float | None
    a0_of_bodies: float | None
    participation: Participation | None
    unique: Literal["only", "one_of_several", "unknown"] | None
    control_delta: float | None
    capacity: Capacity | None
    demand: Demand | None


class Participation(Record):
    """What of the mass takes part in a mechanism.

    Attributes
    ----------
    weight : float
        Weight of the masses that move, Σ(P+Q), N.
    e_star : float
        Share of it that takes part, e*.
    mass : float
        Mass that takes part, M*, kg.
    delta_star : float
        Σ(P+Q)δ² / Σ(P+Q)δ: what the way of a point is multiplied by, over its own δ, to give
        the equivalent displacement.
    e_star_of_bodies : float
        e* with blocks that move as one body counted as one, at their common centre of mass:
        never less than e*, so that its acceleration is never more.
    masses : list of Share
        The masses.
    """

    weight: float
    e_star: float
    mass: float
    delta_star: float
    e_star_of_bodies: float
    masses: list[Share]


class Share(Record):
    """A mass that takes part.

    Attributes
    ----------
    kind : {"block", "rests", "pushes"}
        What it is.

        * ``block``: The block itself.
        * ``rests``: A dead load along gravity: it rests on the block and is pushed (P).
        * ``pushes``: It is pushed against the block and rests elsewhere (Q).

    block : str
        The block that it moves with.
    at : three numbers
        Where it acts, m.
    weight : float
        Its weight, N.
    delta : float
        δ: its virtual displacement towards the earthquake, the greatest of all being 1 in size.
    """

    kind: Literal["block", "rests", "pushes"]
    block: str
    at: tuple[float, float, float]
    weight: float
    delta: float


class Capacity(Record):
    """What the capacity curve gives.

    Attributes
    ----------
    d_over_control : float
        Equivalent displacement over the way of the control point.
    a0 : float
        Acceleration at the start of the curve, m/s²: of what lasts.
    control_d0 : float
        Way of the control point at which the curve vanishes, m.
    d0 : float
        The equivalent displacement there, m.
    exact : States or None
        On the exact curve, whose points are proved.
    straight : States
        On the straight line from a0 to d0, a convention.
    """

    d_over_control: float
    a0: float
    control_d0: float
    d0: float
    exact: States | None
    straight: States


class States(Record):
    """Both limit states on one curve.

    Attributes
    ----------
    slv : LimitState
        Safeguarding life, at 0.4 d0.
    slc : LimitState
        Preventing collapse, at 0.6 d0.
    """

    slv: LimitState
    slc: LimitState


class LimitState(Record):
    """A limit state on a curve.

    Attributes
    ----------
    d : float
        Equivalent displacement, m.
    a : float
        Acceleration there, m/s².
    period : float
        Secant period, s.
    """

    d: float
    a: float
    period: float


class Demand(Record):
    """What the site demands.

    Attributes
    ----------
    ratio : float
        The least ratio of all checks.
    linear : float
        The least ratio of the linear checks: a0 against accelerations over q.
    displacement : float or None
        The least ratio of the checks of displacements, on the exact curve and on the straight
        line.
    checks : list of Check
        The checks.
    gamma_1 : float or None
        γ1 of the building, where there is one.
    a_z : float or None
        a_Z, m/s²: the acceleration of the floor, where there is a building; of SLV.
    left_out : list of str
        What is not checked, and why.
    """

    ratio: float
    linear: float
    displacement: float | None
    checks: list[Check]
    gamma_1: float | None
    a_z: float | None
    left_out: list[str]


class Check(Record):
    """One check: what is met over what is demanded.

    Attributes
    ----------
    what : str
        What is compared, with its formula.
    capacity : float
        What the mechanism has, m/s² or m.
    demand : float
        What is demanded, in the same unit.
    ratio : float
        Capacity over demand.
    """

    what: str
    capacity: float
    demand: float
    ratio: float


class LeastMargin(Record):
    """A least margin.

    Attributes
    ----------
    stage : str
        The stage.
    value : float or None
        The margin; absent where it did not come out, or has no limit.
    status : {"found", "unbounded", "impossible", "at_least", "not_at_rest", "undecided"}
        What became of it.

        * ``found``: There is a value.
        * ``unbounded``: There is no limit.
        * ``impossible``: No load factor lets the scene stand.
        * ``at_least``: It is not less than ``lower``, which another answer is known to bear;
          how much more was not asked.
        * ``not_at_rest``: Under the dead load alone it does not come to rest: there is no value
          with dry friction. It falls where the bound is below zero, and needs self-stress
          otherwise.
        * ``undecided``: It did not come out.
    """

    stage: str
    value: float | None
    status: Literal["found", "unbounded", "impossible", "at_least", "not_at_rest", "undecided"]


class WithoutBlock(Record):
    """A scene without one block.

    Attributes
    ----------
    block : str
        The block that is taken out.
    verdict : Verdict
        The verdict.
    law : {"associative", "coulomb"} or None
        It stands: for which law of sliding. With ``associative`` forces exist, and whether the
        loads produce them was not asked.

        * ``associative``: A joint that slides opens by μ × the slip. Admissible forces are then
          enough to stand.
        * ``coulomb``: Dry friction: a joint slides without opening. Forces must also be such as
          the loads produce.

    equilibrium_error : Bracket
        Bracket of the least equilibrium error, in multiples of gravity.
    part : Deciding or None
        The part of the scene that decides, where it has several.
    proof : "exact" or dict or None
        How exactly it is proved; nothing where it is undecided.
    moving : list of str
        The blocks that move then, the fastest first.
    """

    block: str
    verdict: Verdict
    law: Literal["associative", "coulomb"] | None
    equilibrium_error: Bracket
    part: Deciding | None
    proof: Literal["exact"] | dict[str, Any] | None
    moving: list[str]


class Residuals(Record):
    """What is left of each condition; zero is exact. What is greatest is so among the
    joints of the same blocks.

    Attributes
    ----------
    balance : float
        Greatest equilibrium error of a block, in multiples of its load.
    gap : float
        ``ḡ ≥ 0``: the deepest gap below zero beside what the joint itself closes, in multiples
        of the greatest closing.
    pressure : float
        ``p ≥ 0``: the greatest pull at a point, in multiples of the greatest force at one.
    complementarity : float
        ``ḡ p = 0``: the greatest product, in multiples of both.
    cone : float
        ``‖t‖ ≤ μ p``: the greatest excess at a point, in multiples of the greatest force at
        one.
    sticking : float
        Slip only at the limit: the greatest slip at a point below its limit times what is left
        to it, in multiples of the greatest slip and force.
    direction : float
        Slip along the shear force's other way: the greatest difference from it, in multiples of
        the greatest slip.
    """

    balance: float
    gap: float
    pressure: float
    complementarity: float
    cone: float
    sticking: float
    direction: float


class Displacement(Record):
    """How far a block has moved: small displacements.

    Attributes
    ----------
    block : str
        The block.
    displacement : three numbers
        Of its centre of mass, m.
    rotation : three numbers
        Rotation vector, rad.
    """

    block: str
    displacement: tuple[float, float, float]
    rotation: tuple[float, float, float]


class JointState(Record):
    """What a joint does.

    Attributes
    ----------
    between : two of str
        The two blocks; forces act on the second.
    at : three numbers
        The mean of its corners, m.
    normal : three numbers
        Unit normal from the first block into the second.
    normal_force : float
        Pressing force, N.
    shear_force : float
        Size of the shear force, N.
    force : three numbers
        Force on the second block, N.
    moment : three numbers
        Its moment about ``at``, N·m.
    greatest_pressure : float
        Greatest pressure, Pa; of spheres by Hertz.
    pressed_area : float
        Pressed area, m²; of spheres the circle of contact.
    pressed_share : float or None
        Its share of the joint; absent of spheres.
    opening : float
        How far its sides are apart where they are farthest, m; 0 where all of it presses.
    closing : float
        How far they have come closer where they have most, m; of spheres their approach.
    shear_displacement : float
        Displacement of the second block against the first at ``at``, along the joint, m.
    slip : float
        The longest way that a point of it slid in this step, m.
    touch : {"pressed", "partly_open", "open"}
        How much of it presses.

        * ``pressed``: All of it.
        * ``partly_open``: A part of it.
        * ``open``: Nothing.

    grip : {"sticks", "slips", "slides"}
        How much of that slides.

        * ``sticks``: Nothing.
        * ``slips``: A part.
        * ``slides``: All of it: the joint slides.
    """

    between: tuple[str, str]
    at: tuple[float, float, float]
    normal: tuple[float, float, float]
    normal_force: float
    shear_force: float
    force: tuple[float, float, float]
    moment: tuple[float, float, float]
    greatest_pressure: float
    pressed_area: float
    pressed_share: float | None
    opening: float
    closing: float
    shear_displacement: float
    slip: float
    touch: Literal["pressed", "partly_open", "open"]
    grip: Literal["sticks", "slips", "slides"]


class Greatest(Record):
    """The greatest numbers of a state, with where they are.

    Attributes
    ----------
    displacement : float
        Displacement of a centre of mass, m.
    block : str
        The block.
    pressure : float
        Pressure, Pa.
    between : two of str
        The joint.
    opening : float
        Opening, m.
    slip : float
        Slip, m.
    """

    displacement: float
    block: str
    pressure: float
    between: tuple[str, str]
    opening: float
    slip: float


class PathFactor(Record):
    """How far a path goes.

    Attributes
    ----------
    end : {"none", "bound", "unbounded", "no_balance", "open"}
        How it ended.

        * ``none``: There is no live load, or it was not asked about.
        * ``bound``: A thousandth below the bound of limit analysis; where anything slides, and
          displacements do not grow without end, a millionth.
        * ``unbounded``: There is no bound: at ten times the load factor at which live and dead
          load weigh the same.
        * ``no_balance``: No displacements balance the loads beyond.
        * ``open``: It was not followed to its end.

    value : float or None
        The load factor of the path: where nothing slides on the way the proved bound, else the
        greatest at which a state was found. Absent where it was not followed to its end.
    reached : float
        The greatest load factor at which a state was found.
    slides : bool
        Whether anything slides on the way.
    associative : Bound
        The bound by limit analysis: never below.
    """

    end: Literal["none", "bound", "unbounded", "no_balance", "open"]
    value: float | None
    reached: float
    slides: bool
    associative: Bound


class Watched(Record):
    """A point of a block.

    Attributes
    ----------
    block : str
        The block.
    point : three numbers
        Where it is at the start, m.
    """

    block: str
    point: tuple[float, float, float]


class CurvePoint(Record):
    """A point of the curve.

    Attributes
    ----------
    load_factor : float
        The load factor.
    displacement : three numbers
        Displacement of the control point, m.
    rotation : three numbers
        Rotation vector of its block, rad.
    """

    load_factor: float
    displacement: tuple[float, float, float]
    rotation: tuple[float, float, float]


class Event(Record):
    """What happens to a joint, or to a member.

    Attributes
    ----------
    load_factor : float
        The load factor at which it has happened.
    kind : {"opens", "closes", "parts", "touches", "slips", "slides", "sticks", "slackens", "tightens", "yields", "holds"}
        What.

        * ``opens``: Its edge opens.
        * ``closes``: All of it presses again.
        * ``parts``: It parts altogether.
        * ``touches``: It touches again.
        * ``slips``: A part of it begins to slide.
        * ``slides``: All of it slides.
        * ``sticks``: It sticks again.
        * ``slackens``: A member goes slack.
        * ``tightens``: It carries again.
        * ``yields``: It has reached its strength.
        * ``holds``: It carries less than its strength again.

    between : two of str or None
        The joint.
    member : str or None
        The member.
    """

    load_factor: float
    kind: Literal["opens", "closes", "parts", "touches", "slips", "slides", "sticks", "slackens", "tightens", "yields", "holds"]
    between: tuple[str, str] | None
    member: str | None


class MemberLine(Record):
    """The force in one member: of the forces that prove the answer, which may not be the
    only ones.

    Attributes
    ----------
    member : str
        Its name; that of a strip with the number of the joint.
    kind : {"tie", "strut", "bar", "tendon", "strip", "dowel", "soil", "grip", "toothing"}
        What it is.

        * ``tie``: Only pulls.
        * ``strut``: Only pushes.
        * ``bar``: Pulls and pushes.
        * ``tendon``: Pulls along several points.
        * ``strip``: One joint of a bonded strip.
        * ``dowel``: Shear across a joint.
        * ``soil``: Soil behind a face.
        * ``grip``: A finger.
        * ``toothing``: The friction of a toothed corner.

    force : float
        The force, N: tension > 0 in a tie, strut, bar or tendon; the size of a shear; the
        normal force of a finger.
    friction : float or None
        The friction force of a finger, N.
    least : float or None
        Its least force, N, where there is one.
    greatest : float or None
        Its greatest force, N, where there is one.
    state : {"slack", "carries", "at_strength"}
        How it carries.

        * ``slack``: Next to nothing.
        * ``carries``: Less than its strength.
        * ``at_strength``: As much as it can.
    """

    member: str
    kind: Literal["tie", "strut", "bar", "tendon", "strip", "dowel", "soil", "grip", "toothing"]
    force: float
    friction: float | None
    least: float | None
    greatest: float | None
    state: Literal["slack", "carries", "at_strength"]


class ShakeOptions(Record):
    """Options of ``shake``: all blocks of a scene on ground that moves.

    Attributes
    ----------
    toward : three numbers
        The direction in which the ground moves, made horizontal; (1, 0, 0) where nothing is
        said.
    ground : Given or None
        How the ground moves.
    fast : bool
        Fast steps: an impact loses 0.7 % more of the speed than with fine ones.
    seconds : float or None
        Time to simulate at most, s; that of the motion and as long as a fall takes after it
        where nothing is said.
    to_the_end : bool
        Simulate until then although something overturned or everything is at rest.
    """

    toward: tuple[float, float, float]
    ground: Given | None
    fast: bool
    seconds: float | None
    to_the_end: bool


class Given(Record):
    """How the ground moves: by a pulse or by a record, times a scale; at rest where neither
    is given.

    Attributes
    ----------
    pulse : dict or None
        A formula.
    record : str or Series or None
        A record: in a plan the name of its file, relative to the folder of the plan; in a
        result the record itself.
    scale : float or None
        It is multiplied by this. Default 1.
    """

    pulse: dict[str, Any] | None
    record: str | Series | None
    scale: float | None


class Series(Record):
    """Accelerations at even times, m/s².

    Attributes
    ----------
    name : str
        The files, as they were named.
    step : float
        Time between two samples, s.
    components : list of list of float
        One to three components: along the direction asked about, to its left, up. Samples of
        each.
    """

    name: str
    step: float
    components: list[list[float]]


class ShakenBlock(Record):
    """What a block did, ways in its own thickness.

    Attributes
    ----------
    block : str
        The block.
    thickness : float
        Its thickness, m.
    greatest_over_thickness : float
        The greatest way of its centre of mass over its thickness.
    at : float
        When, s.
    residual_over_thickness : float
        Its way at the end over its thickness.
    greatest_turn_deg : float
        The greatest angle by which it had turned, degrees.
    """

    block: str
    thickness: float
    greatest_over_thickness: float
    at: float
    residual_over_thickness: float
    greatest_turn_deg: float


class InCombination(Record):
    """The answer in one combination.

    Attributes
    ----------
    name : str
        Its name.
    source : str
        Where its factors come from.
    factors : dict of names to float
        Factors on loads, by action; 0 for one that does not act.
    materials : MaterialFactors
        What strengths are divided by.
    answer : dict
        The answer.
    required : Required or None
        What was required of it, and whether it is met.
    """

    name: str
    source: str
    factors: dict[str, float]
    materials: MaterialFactors
    answer: dict[str, Any]
    required: Required | None


class MaterialFactors(Record):
    """Partial factors that strengths are divided by; 1 where nothing is said.

    Attributes
    ----------
    friction : float or None
        On the coefficient of friction (tan φ).
    cohesion : float or None
        On the cohesion.
    tension : float or None
        On the tensile strength.
    compression : float or None
        On the compressive strength.
    members : float or None
        On the strengths of members: ties, struts, strips, soil, …
    """

    friction: float | None
    cohesion: float | None
    tension: float | None
    compression: float | None
    members: float | None


class Required(Record):
    """What was required of an answer; of several requirements the one that is met least.

    Attributes
    ----------
    quantity : {"load_factor", "tilt_deg", "alpha0", "geometric_factor", "site"}
        Of what.

        * ``load_factor``: A load factor λ.
        * ``tilt_deg``: A tilt, degrees.
        * ``alpha0``: The load factor α0 of an earthquake.
        * ``geometric_factor``: The geometric safety factor.
        * ``site``: ζ_E, the share of the earthquake of the site.

    least : float
        The least value that is enough.
    obtained : float or None
        The value that is there, where it is known.
    met : bool or None
        Whether it is reached; absent where that is open.
    """

    quantity: Literal["load_factor", "tilt_deg", "alpha0", "geometric_factor", "site"]
    least: float
    obtained: float | None
    met: bool | None


class MeetChange(Record):
    """A change between two values, each proved.

    Attributes
    ----------
    met_at : float
        The value at which what is required is met.
    met : Nested
        The answer there.
    not_met_at : float
        The value beside it at which it is not.
    not_met : Nested
        The answer there.
    """

    met_at: float
    met: Nested
    not_met_at: float
    not_met: Nested


class Nested(Record):
    """The answer to a question about one of several scenes.

    Attributes
    ----------
    answer : dict
        The answer.
    required : Required or None
        What was required of it, and whether it is met.
    """

    answer: dict[str, Any]
    required: Required | None


class MeetPoint(Record):
    """A value of the scan. Computed.

    Attributes
    ----------
    value : float
        The value.
    met : bool or None
        Whether what is required is met; absent where that is open, or there is no scene.
    obtained : float or None
        What is obtained of it.
    """

    value: float
    met: bool | None
    obtained: float | None


class CriticalResult(Record):
    """The scan and the flips.

    Attributes
    ----------
    vary : str
        JSON pointer of the number that varies.
    between : two numbers
        The range.
    whole : bool
        Whether the number is a count.
    complete : bool
        Whether the scan reached the other end.
    scan : list of ScanPoint
        The scan: computed, not proved.
    flips : list of FlipResult
        The flips, in the order of the scan.
    ends : list of Side
        Without a flip: the verdicts at the ends of the range.
    """

    vary: str
    between: tuple[float, float]
    whole: bool
    complete: bool
    scan: list[ScanPoint]
    flips: list[FlipResult]
    ends: list[Side]


class ScanPoint(Record):
    """A value of the scan. Computed.

    Attributes
    ----------
    value : float
        The value.
    verdict : Verdict or None
        Its verdict; absent where there is no scene with this value.
    equilibrium_error : float or None
        Its least equilibrium error, g, as the mechanism bounds it from below.
    """

    value: float
    verdict: Verdict | None
    equilibrium_error: float | None


class FlipResult(Record):
    """A flip.

    Attributes
    ----------
    value : float
        The value.
    method : {"margin", "halving", "scan"}
        How it was found.

        * ``margin``: The zero of the least equilibrium error.
        * ``halving``: By halving the range.
        * ``scan``: Between two neighbours of the scan (a count, or a range that could not be
          narrowed).

    below : Side
        The nearest value below.
    above : Side
        The nearest value above.
    """

    value: float
    method: Literal["margin", "halving", "scan"]
    below: Side
    above: Side


class Side(Record):
    """One value with its verdict and the evidence for it.

    Attributes
    ----------
    value : float
        The value.
    answer : dict
        The verdict.
    """

    value: float
    answer: dict[str, Any]


class CriticalValue(Record):
    """A value at which the verdict flips.

    Attributes
    ----------
    value : float
        The value.
    lower : float
        The nearest value below whose verdict is proved.
    upper : float
        The nearest value above whose verdict is proved.
    below : Verdict
        The verdict below.
    above : Verdict
        The verdict above.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> friction = "/joints/default/friction"
    >>> tilted = table.load("dead", weight=(0.3, 0, 0))
    >>> (critical,) = voussoir.critical(tilted, friction, (0.1, 0.6), scan=4).values
    >>> round(critical.value, 4), critical.below.value, critical.above.value
    (0.3, 'unstable', 'stable')
    """

    value: float
    lower: float
    upper: float
    below: Verdict
    above: Verdict


class PathResult(Record):
    """The curve.

    Attributes
    ----------
    driven_by : dict
        What moves it.
    points : list of PathPoint
        Points, in order. A jump has two at one value.
    events : list of PathEvent
        What happens on the way.
    ends : list of PathPoint
        It falls: the last pose that is proved to stand and the first that is proved to fall, of
        the same linkage.
    """

    driven_by: dict[str, Any]
    points: list[PathPoint]
    events: list[PathEvent]
    ends: list[PathPoint]


class PathPoint(Record):
    """A point of the curve: a scene of its own.

    Attributes
    ----------
    value : float
        The parameter.
    load_factor : float or None
        The load factor, where there is a live load; that of the certificate.
    reactions : list of Reaction
        The blocks' forces on the supports that move.
    hinges : list of Hinge
        Joints that have opened and still touch.
    slips : list of Slip
        Joints that have slid and still touch.
    bound : float or None
        Of a load factor with dry friction, or where a joint slides and none is known: the load
        factor of joints that open as they slide, which no value passes.
    """

    value: float
    load_factor: float | None
    reactions: list[Reaction]
    hinges: list[Hinge]
    slips: list[Slip]
    bound: float | None


class Reaction(Record):
    """The blocks' force on a support.

    Attributes
    ----------
    support : str
        The support.
    force : three numbers
        N.
    moment : three numbers
        About its centre of mass, N·m.
    """

    support: str
    force: tuple[float, float, float]
    moment: tuple[float, float, float]


class Hinge(Record):
    """A joint that has opened and still touches.

    Attributes
    ----------
    between : two of str
        The blocks.
    at : three numbers
        The middle of what touches, m.
    width : float
        How wide it is open at most, m.
    """

    between: tuple[str, str]
    at: tuple[float, float, float]
    width: float


class Slip(Record):
    """A joint that has slid and still touches.

    Attributes
    ----------
    between : two of str
        The blocks.
    at : three numbers
        The middle of what touches, m.
    way : float
        How far the blocks have slid there since the start at most, m.
    """

    between: tuple[str, str]
    at: tuple[float, float, float]
    way: float


class PathEvent(Record):
    """Something that happens on the way, as poses, forces and rates of the points show it.

    Attributes
    ----------
    value : float
        The parameter.
    kind : {"opens", "closes", "jumps", "falls", "yields", "slides", "sticks"}
        What.

        * ``opens``: Another joint opens, and the motion goes on steadily.
        * ``closes``: A joint closes.
        * ``jumps``: The motion turns back: it goes on elsewhere at the same value, by a jump.
        * ``falls``: It falls as these joints open.
        * ``yields``: A member reaches what it can carry: from here on it yields, or goes slack.
        * ``slides``: Joints slide from here on: followed under dry friction, without opening.
        * ``sticks``: Joints that slid stick from here on.

    opens : list of two of str
        Joints that open.
    closes : list of two of str
        Joints that close.
    yields : list of str
        Members that yield, or that go slack as it falls.
    slides : list of two of str
        Joints that begin to slide, or that stick again.
    jump : float or None
        The longest way of a block in a jump, m.
    """

    value: float
    kind: Literal["opens", "closes", "jumps", "falls", "yields", "slides", "sticks"]
    opens: list[tuple[str, str]]
    closes: list[tuple[str, str]]
    yields: list[str]
    slides: list[tuple[str, str]]
    jump: float | None


class StagesResult(Record):
    """All stages.

    Attributes
    ----------
    order : Order or None
        The stages are those of this order.
    hands : int or None
        So many blocks can be held at a time, where that was said.
    list : list of StageResult
        In their order.
    """

    order: Order | None
    hands: int | None
    list: list[StageResult]


class Order(Record):
    """An order in which a structure is built block by block, and what is held on the way.

    Attributes
    ----------
    given : bool
        It was given; else it was sought.
    tries : int
        Sets of blocks looked at, at most.
    least_held : int
        With fewer held at a time there is no such order: computed by a search through all of
        them, not proved. Where tries or time were up, as far as it went.
    placed : list of Placed
        The blocks in their order; none where time was up before one was found.
    """

    given: bool
    tries: int
    least_held: int
    placed: list[Placed]


class Placed(Record):
    """A block that is placed in a structure, and the blocks that are held while it stands
    as far as that.

    Attributes
    ----------
    block : str
        The block that comes.
    held : list of str
        Free blocks that are held then; it may be one of them.
    """

    block: str
    held: list[str]


class StageResult(Record):
    """One stage.

    Attributes
    ----------
    name : str
        Its name.
    blocks : int
        Blocks that stand, supports among them.
    held : list of str
        Blocks that this stage holds.
    verdict : dict
        Does it stand?
    margin : dict or None
        Where it stands and that was asked: the load factor of its live load, or else the least
        tilt.
    no_margin : str or None
        Why it has no margin although that was asked: loads that no tilt can turn.
    reactions : list of StageReaction
        Where it stands: the forces of its proof on supports and on what it holds. They are one
        state of equilibrium among others.
    least_forces : list of HeldForce
        Where it stands and that was asked: the least forces on what it holds.
    """

    name: str
    blocks: int
    held: list[str]
    verdict: dict[str, Any]
    margin: dict[str, Any] | None
    no_margin: str | None
    reactions: list[StageReaction]
    least_forces: list[HeldForce]


class StageReaction(Record):
    """A force on a support or on what is held.

    Attributes
    ----------
    support : str
        The block.
    force : three numbers
        The force of the other blocks and of members on it, N.
    moment : three numbers
        Its moment about the block's centre of mass, N·m.
    """

    support: str
    force: tuple[float, float, float]
    moment: tuple[float, float, float]


class HeldForce(Record):
    """The least force on what is held, along a direction.

    Attributes
    ----------
    block : str
        The block that is held.
    direction : three numbers
        Unit direction: down, or outwards.
    least : Bound
        The least force of the other blocks on it along that, N; its own weight is not in it.
        Below zero: they can push it the other way.
    weight : float
        Its own weight along that, N.
    needed : float or None
        The least force that holds it against that, N: 0 where the others can do without.
        Nothing where the least force did not come out.
    """

    block: str
    direction: tuple[float, float, float]
    least: Bound
    weight: float
    needed: float | None


class ThrustResult(Record):
    """The evidence, and the line of thrust.

    Attributes
    ----------
    shrunk : list of Side
        Shrunk sections, with the verdict at each: ``value`` is the share of the section that is
        left.
    sections : list of ThrustSection
        The line of thrust, section by section.
    """

    shrunk: list[Side]
    sections: list[ThrustSection]


class ThrustSection(Record):
    """A section with the lines of thrust through it.

    Attributes
    ----------
    between : two of str
        The two blocks.
    least : ThrustLine or None
        At the least thrust, where found.
    greatest : ThrustLine or None
        At the greatest.
    """

    between: tuple[str, str]
    least: ThrustLine | None
    greatest: ThrustLine | None


class ThrustLine(Record):
    """The line of thrust at a section.

    Attributes
    ----------
    normal : float
        Normal force, N; compression > 0.
    shear : float
        Shear force, N.
    at : three numbers
        Centre of pressure, m.
    eccentricity : float
        Its distance from the centroid, m.
    used : float
        Share of the section used: 1 at the edge.
    in_kern : bool
        Whether it lies in the kern: the whole section presses.
    inside : bool
        Whether it lies inside the section.
    """

    normal: float
    shear: float
    at: tuple[float, float, float]
    eccentricity: float
    used: float
    in_kern: bool
    inside: bool


class Simulated(Record):
    """What happened in time, as an answer tells it. Observed, not proved.

    Attributes
    ----------
    fate : {"stands", "falls", "undecided"}
        What became of it.

        * ``stands``: It came to rest where it was.
        * ``falls``: A block moved by more than [``FALLEN``](base::tolerance::FALLEN) × its
          thickness and was still moving.
        * ``undecided``: Neither.

    collapse : float or None
        When the first block had fallen, s.
    runs : list of Run
        The runs, the decisive one last.
    agreement : Agreement or None
        Beside the verdict, where there is one.
    first_motion : list of BlockMotion
        The first motion, the blocks that moved farthest first; blocks at rest are left out.
    contacts : list of PairForce
        Contact forces at the end.
    reaction_error : float
        What is left when the contact forces on the supports and all loads are added up, over
        the loads: 0 at rest.
    findings : list of Note
        What the simulation could not respect.
    """

    fate: Literal["stands", "falls", "undecided"]
    collapse: float | None
    runs: list[Run]
    agreement: Agreement | None
    first_motion: list[BlockMotion]
    contacts: list[PairForce]
    reaction_error: float
    findings: list[Note]


class Run(Record):
    """One run of the engine.

    Attributes
    ----------
    fidelity : {"fast", "fine"}
        Settings.

        * ``fast``: √(L/g) / 100, L the median block size, 20 substeps: to be trusted 3 % away
          from a critical parameter.
        * ``fine``: √(L/g) / 400, 20 substeps: to be trusted 1 % away from it.

    fate : {"stands", "falls", "undecided"}
        What it shows.

        * ``stands``: It came to rest where it was.
        * ``falls``: A block moved by more than [``FALLEN``](base::tolerance::FALLEN) × its
          thickness and was still moving.
        * ``undecided``: Neither.

    stop : {"fallen", "rest", "horizon", "stopped", "broken"}
        Why it ended.

        * ``fallen``: A block had fallen.
        * ``rest``: Everything rested long enough.
        * ``horizon``: The horizon was reached.
        * ``stopped``: The caller wanted no more.
        * ``broken``: The engine's numbers were no longer finite.

    step : float
        Length of a step, s.
    substeps : int
        Substeps of a step.
    steps : int
        Steps taken.
    time : float
        Time simulated, s.
    horizon : float
        Time allowed, s.
    farthest : str
        The block that moved farthest for its thickness; empty where nothing is free.
    displacement : float
        How far, over all times: its centre's way and the way of its farthest corner about it,
        m.
    relative : float
        The same over the least thickness of that block.
    energy : float
        Largest kinetic energy of a block at the end over its m g L.
    """

    fidelity: Literal["fast", "fine"]
    fate: Literal["stands", "falls", "undecided"]
    stop: Literal["fallen", "rest", "horizon", "stopped", "broken"]
    step: float
    substeps: int
    steps: int
    time: float
    horizon: float
    farthest: str
    displacement: float
    relative: float
    energy: float


class Agreement(Record):
    """How far a verdict and a simulation agree.

    Attributes
    ----------
    verdict : Verdict
        The verdict.
    fate : {"stands", "falls", "undecided"}
        What the simulation showed.

        * ``stands``: It came to rest where it was.
        * ``falls``: A block moved by more than [``FALLEN``](base::tolerance::FALLEN) × its
          thickness and was still moving.
        * ``undecided``: Neither.

    agrees : bool or None
        Whether they say the same; absent where one of them is undecided, or the joints have
        strengths that the simulation leaves out. A conditional verdict says that it falls,
        because the simulation starts without self-stress.
    motion : float or None
        Where both fall: cosine between the first motion and the mechanism, in the metric of the
        kinetic energy. 1 is the same motion; a scene with several ways to fall takes the
        fastest, the mechanism is the one that proves most.
    forces : ForceAgreement or None
        Where both stand and the contact forces are known.
    """

    verdict: Verdict
    fate: Literal["stands", "falls", "undecided"]
    agrees: bool | None
    motion: float | None
    forces: ForceAgreement | None


class ForceAgreement(Record):
    """The forces between blocks, simulated against computed.

    Attributes
    ----------
    largest : float
        Largest difference between the two resultants of a pair of blocks, over the largest
        resultant.
    between : two of str
        The pair it is found on.
    mean : float
        Root of the mean square of the differences over the root of the mean square of the
        resultants.
    pairs : int
        Pairs compared.
    determinate : bool
        Whether statics alone fixes the resultants; if not, they depend on how contacts yield,
        and the two methods need not agree.
    """

    largest: float
    between: tuple[str, str]
    mean: float
    pairs: int
    determinate: bool


class BlockMotion(Record):
    """How a block began to move.

    Attributes
    ----------
    block : str
        The block.
    way : three numbers
        Way of its centre of mass, m.
    turn : three numbers
        Its rotation vector, radians.
    """

    block: str
    way: tuple[float, float, float]
    turn: tuple[float, float, float]


class PairForce(Record):
    """The contact force between two blocks.

    Attributes
    ----------
    between : two of str
        The blocks.
    force : three numbers
        Force on the second, N.
    """

    between: tuple[str, str]
    force: tuple[float, float, float]


class Note(Record):
    """Something the user should know although the work went on: a repair, a near miss, an
    assumption.

    Attributes
    ----------
    code : {"assumed", "mended", "warped", "gap_closed", "near_miss", "unjoined", "overlap", "twice", "contact_ignored", "flattened", "floating", "orientation", "units", "axes", "loads", "numerics", "missing", "left_out", "without_effect", "converted", "worst_case", "factored"}
        What kind of thing it is, for programs.

        * ``assumed``: A value nobody gave was assumed.
        * ``mended``: Input geometry was mended (welded vertices, turned faces, …).
        * ``warped``: Faces that are not plane are treated as plane.
        * ``gap_closed``: Gaps within the tolerance were closed.
        * ``near_miss``: Faces that nearly touch were left apart.
        * ``unjoined``: Most blocks touch nothing: their joints are open.
        * ``overlap``: Blocks overlap.
        * ``twice``: A block is drawn twice.
        * ``contact_ignored``: Contacts between other blocks' faces, or below the least area,
          were ignored.
        * ``flattened``: Edges or corners that meet others, with several normals, stand for
          small flats.
        * ``floating``: Free blocks without a contact path to a support.
        * ``orientation``: A given normal that points against the line from the first block's
          centre to the second's.
        * ``units``: Numbers that look like a mistake of units.
        * ``axes``: Supports face another way than gravity pulls: a mistake of axes.
        * ``loads``: A load that acts off its block, or does not say what it seems to.
        * ``numerics``: Something about the way the numbers were found.
        * ``missing``: Something that is needed later was not given.
        * ``left_out``: A part of a foreign file has no counterpart in a scene, or is unusable,
          and was left out.
        * ``without_effect``: A property of a joint that its contact cannot use.
        * ``converted``: How a foreign file was read where there was a choice.
        * ``worst_case``: Which values of a range are the worst, and why.
        * ``factored``: Partial factors are in force.

    text : str
        One sentence with its numbers, for people.
    """

    code: Literal["assumed", "mended", "warped", "gap_closed", "near_miss", "unjoined", "overlap", "twice", "contact_ignored", "flattened", "floating", "orientation", "units", "axes", "loads", "numerics", "missing", "left_out", "without_effect", "converted", "worst_case", "factored"]
    text: str


class Mechanism(Record):
    """A mechanism with names.

    Attributes
    ----------
    moving : list of str
        Moving blocks, the fastest first.
    joints : list of JointMotion
        Moving joints.
    members : list of MemberMotion
        Members that yield, go slack or slide.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.limit(table.load("live", weight=(1, 0, 0)))
    >>> answer.mechanism.moving, len(answer.mechanism.joints)
    (['block'], 1)
    """

    moving: list[str]
    joints: list[JointMotion]
    members: list[MemberMotion]


class JointMotion(Record):
    """A joint of a mechanism with names.

    Attributes
    ----------
    between : two of str
        The blocks.
    motion : {"hinge", "slide", "hinge_and_slide", "part", "crush"}
        What it does.

        * ``hinge``: Turns about an edge or a corner that stays in contact.
        * ``slide``: Slides (with the associated lift μ‖v_t‖ that limit analysis gives a sliding
          joint).
        * ``hinge_and_slide``: Turns about an edge that slides.
        * ``part``: Parts over its whole area.
        * ``crush``: Turns about a line inside the contact; what lies beyond it is crushed.

    at : three numbers
        Where, m.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.limit(table.load("live", weight=(1, 0, 0)))
    >>> (joint,) = answer.mechanism.joints
    >>> joint.between, joint.motion
    (('ground', 'block'), 'hinge')
    """

    between: tuple[str, str]
    motion: Literal["hinge", "slide", "hinge_and_slide", "part", "crush"]
    at: tuple[float, float, float]


class MemberMotion(Record):
    """A member of a mechanism.

    Attributes
    ----------
    member : str
        Its name.
    motion : {"yields", "slackens", "slides"}
        What it does.

        * ``yields``: Gives way at its strength: a tie lengthens, a strut shortens, soil is
          pushed back.
        * ``slackens``: Goes slack, or lets go.
        * ``slides``: A finger slides over the block.
    """

    member: str
    motion: Literal["yields", "slackens", "slides"]


class Doubt(Record):
    """Why an answer is undecided.

    Attributes
    ----------
    cause : {"edges", "time_limit", "refused", "dry_friction", "wide_numbers", "on_the_line", "open_bracket", "no_attempt", "range", "still_moving", "broke_off"}
        The most probable cause.

        * ``edges``: Edges or corners meet with several normals, and which of them acts decides.
        * ``time_limit``: Time was over first.
        * ``refused``: What came out did not pass its own check on the scene.
        * ``dry_friction``: The state under dry friction came neither to rest nor to a motion.
        * ``wide_numbers``: Masses, sizes or friction of the scene are spread wider than the
          numbers of a solver carry.
        * ``on_the_line``: The scene lies on the line between standing and falling, as far as
          numbers tell.
        * ``open_bracket``: The bracket closed in part, and no attempt closed it further.
        * ``no_attempt``: No attempt of the solver came to anything.
        * ``range``: Values of the range make no scene, or are undecided themselves.
        * ``still_moving``: In time it neither rests nor has fallen.
        * ``broke_off``: The simulation broke off.

    evidence : str
        What speaks for it, with its numbers.
    next : str
        The one thing to do next.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=27))
    >>> doubt = voussoir.assess(arch, time_limit=1e-9).doubt
    >>> doubt.cause
    'time_limit'
    """

    cause: Literal["edges", "time_limit", "refused", "dry_friction", "wide_numbers", "on_the_line", "open_bracket", "no_attempt", "range", "still_moving", "broke_off"]
    evidence: str
    next: str


class Why(Record):
    """Why something is not in an answer.

    Attributes
    ----------
    path : str or None
        A path was not followed any further.
    no_curve : str or None
        There is no curve.
    no_curve_with_members : str or None
        There is no curve with members.
    without_factor : str or None
        There is no geometric safety factor.
    stages : list of tuple of str and Doubt
        Stages are undecided, by their names.
    no_scene : list of tuple of float and str
        Values of a range make no scene.
    range : list of str
        What is said of a range.
    """

    path: str | None
    no_curve: str | None
    no_curve_with_members: str | None
    without_factor: str | None
    stages: list[tuple[str, Doubt]]
    no_scene: list[tuple[float, str]]
    range: list[str]


class Sensitivity(Record):
    """How a value changes with every number that was assumed.

    Attributes
    ----------
    of : {"load_factor", "tilt_deg", "alpha0"}
        What changes.

        * ``load_factor``: The load factor λ.
        * ``tilt_deg``: The tilt, degrees.
        * ``alpha0``: The load factor α0 of an earthquake.

    law : {"associative", "coulomb"}
        For which law of sliding: ``associative`` means the bound.

        * ``associative``: A joint that slides opens by μ × the slip. Admissible forces are then
          enough to stand.
        * ``coulomb``: Dry friction: a joint slides without opening. Forces must also be such as
          the loads produce.

    numbers : list of Derivative
        One a number, the one that matters most first.
    omitted : int or None
        Numbers of the scene that are left out, beyond so many.
    """

    of: Literal["load_factor", "tilt_deg", "alpha0"]
    law: Literal["associative", "coulomb"]
    numbers: list[Derivative]
    omitted: int | None


class Derivative(Record):
    """How a value changes with one number.

    Attributes
    ----------
    pointer : str
        Where the number stands: its JSON pointer into the scene.
    value : float
        The number.
    unit : str
        Its unit; empty where it has none.
    left : float or None
        Change of the value per unit of the number as that falls.
    right : float or None
        The same as it grows.
    per_percent : float or None
        Change of the value where the number changes by 1 % (of a place: by 1 % of the size of
        the block), the greater of both sides in size.
    origin : {"proof", "asked_again", "not_asked"}
        How it is known.

        * ``proof``: From the forces and the mechanism that prove the value: what of them counts
          is the same in all that prove it.
        * ``asked_again``: Asked again with the number a little less and a little more.
          Computed, not proved.
        * ``not_asked``: It has two sides, or slides with dry friction, and was not asked again.
    """

    pointer: str
    value: float
    unit: str
    left: float | None
    right: float | None
    per_percent: float | None
    origin: Literal["proof", "asked_again", "not_asked"]


class AssessmentKeys(Keys):
    """Keys of :class:`voussoir.Assessment`."""

    verdict: Verdict = field("""Verdict: The verdict.""")
    law: Literal["associative", "coulomb"] | None = field("""{"associative", "coulomb"} or None: It stands: for which law of sliding. With
    ``associative`` forces exist, and whether the loads produce them was not asked.

        * ``associative``: A joint that slides opens by μ × the slip. Admissible forces are then
          enough to stand.
        * ``coulomb``: Dry friction: a joint slides without opening. Forces must also be such as
          the loads produce.
    """)
    equilibrium_error: Bracket = field("""Bracket: Bracket of the least equilibrium error, in multiples of gravity.""")
    part: Deciding | None = field("""Deciding or None: The part of the scene that decides, where it has several.""")
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly it is proved; nothing where it is undecided.""")


class LimitKeys(Keys):
    """Keys of :class:`voussoir.Limit`."""

    load_factor: LoadFactor = field("""LoadFactor: The load factor.""")
    verdict: Verdict | None = field("""Verdict or None: Whether it stands without its live load, where that was asked.""")
    part: Deciding | None = field("""Deciding or None: The part of the scene that decides the bound, where it has several.""")
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly the bound is proved; nothing where it is undecided.""")


class MovingKeys(Keys):
    """Keys of :class:`voussoir.Moving`."""

    _place = "moving"
    travel: Literal["forward", "backward"] = field("""{"forward", "backward"}: Which way the train goes.

        * ``forward``: Towards +x.
        * ``backward``: Towards −x, turned round.
    """)
    x: float = field("""float: Where its origin is, x in the scene, m.""")
    axles: list[AxleOnSpan] = field("""list of AxleOnSpan: The axles that stand on a span.""")
    load_factor: LoadFactor = field("""LoadFactor: By how much their forces may be multiplied.""")
    verdict: Verdict | None = field("""Verdict or None: Whether it stands without the train, where that was asked.""")
    part: Deciding | None = field("""Deciding or None: The part of the scene that decides the bound, where it has several.""")
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly that bound is proved; absent where it is undecided.""")


class TiltKeys(Keys):
    """Keys of :class:`voussoir.Tilt`."""

    toward: tuple[float, float, float] = field("""three numbers: The direction of the tilt.""")
    tan_tilt: LoadFactor = field("""LoadFactor: The tangent of the tilt.""")
    tilt_deg: LoadFactor = field("""LoadFactor: The tilt in degrees.""")
    verdict: Verdict | None = field("""Verdict or None: Whether it stands level, where that was asked.""")
    part: Deciding | None = field("""Deciding or None: The part of the scene that decides the bound, where it has several.""")
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly the bound is proved; nothing where it is undecided.""")


class ThrustKeys(Keys):
    """Keys of :class:`voussoir.Thrust`."""

    _place = "thrust"
    support: str | None = field("""str or None: The support.""")
    direction: tuple[float, float, float] | None = field("""three numbers or None: Unit direction of the thrust, or of the shear of a dowel.""")
    member: str | None = field("""str or None: The member whose force is meant, in place of a support.""")
    least: Bound | None = field("""Bound: Its least value.""")
    greatest: Bound | None = field("""Bound: Its greatest value.""")
    geometric_factor: GeometricFactor | None = field("""GeometricFactor or None: The geometric safety factor.""")


class PathKeys(Keys):
    """Keys of :class:`voussoir.Path`."""

    _place = "path"
    status: Literal["reached", "falls", "vanishes", "slides", "open"] = field("""{"reached", "falls", "vanishes", "slides", "open"}: How it ends.

        * ``reached``: All of the movement was followed: it stands to its end.
        * ``falls``: It falls on the way.
        * ``vanishes``: The load factor vanishes: beyond it would have to be pulled back.
        * ``slides``: A joint slides from here on, and no motion under dry friction was found
          that leads on.
        * ``open``: It was not followed any further.
    """)
    value: float | None = field("""float or None: The last value of the parameter that is proved: it stands there, or
    has the load factor of the last point. Settle: a share of the movement; push: the way
    of the control point, m. Absent where nothing is proved.
    """)
    falls_at: float | None = field("""float or None: It falls: at this value it is proved to.""")
    jumps_at: float | None = field("""float or None: It jumps here first: the motion turns back, and what is told of beyond
    is what it may come to by a motion that is not followed.
    """)
    least_reaction: Bracketed | None = field("""Bracketed or None: Settle: the least power that the blocks' forces on the supports
    can have at the start as these begin to move, J per unit of the parameter. Where one
    support moves straight by 1 m it is its least reaction in that direction, N.
    """)


class KinematicKeys(Keys):
    """Keys of :class:`voussoir.Kinematic`."""

    _place = "kinematic"
    toward: tuple[float, float, float] = field("""three numbers: Unit direction across gravity towards which the masses are pushed.""")
    alpha0: LoadFactor = field("""LoadFactor: α0: the share of all weights that, pushing that way, sets the scene moving.""")
    verdict: Verdict | None = field("""Verdict or None: Whether it stands without an earthquake, where that was asked.""")
    part: Deciding | None = field("""Deciding or None: The part of the scene that decides the bound on α0, where it has
    several.
    """)
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly that bound is proved; absent where it is undecided.""")
    fc: float = field("""float: Factor of confidence FC.""")
    control: Control | None = field("""Control or None: The control point of the curve, and by what the equivalent
    displacement is measured.
    """)
    curve: PathAnswer | None = field("""PathAnswer or None: How far the curve was followed.""")
    without_members: bool = field("""bool: The curve is that of the scene without its members: what lasts once these yield.""")
    curve_with_members: PathAnswer | None = field("""PathAnswer or None: How far the curve with members was followed, where the scene has
    any: they hold up to their strength, however far it has moved. Limit states are those
    of ``curve``.
    """)
    numbers: Numbers = field("""Numbers: What follows from the mechanism, the curve and the site.""")
    a0: float | None = field("""float or None: a0 = α0 g / (e* FC), m/s²; absent where α0 was not found.""", within="numbers")
    a0_of_bodies: float | None = field("""float or None: The same with blocks that move as one counted as one, where that is less.""", within="numbers")
    participation: Participation | None = field("""Participation or None: What of the mass takes part: e*, M* and δ of every mass that
    moves.
    """, within="numbers")
    unique: Literal["only", "one_of_several", "unknown"] | None = field("""{"only", "one_of_several", "unknown"} or None: Whether the joints that the mechanism
    keeps closed allow another one.

        * ``only``: The joints that it keeps closed allow no other.
        * ``one_of_several``: They allow others, which start at the same load factor.
        * ``unknown``: Too many bodies move to tell.
    """, within="numbers")
    control_delta: float | None = field("""float or None: δ of the control point, in the measure of the masses' δ.""", within="numbers")
    capacity: Capacity | None = field("""Capacity or None: What the curve gives, where it vanishes.""", within="numbers")
    demand: Demand | None = field("""Demand or None: What the site demands.""", within="numbers")


class StagesKeys(Keys):
    """Keys of :class:`voussoir.Stages`."""

    _place = "stages"
    verdict: Verdict = field("""Verdict: The verdict of the worst stage.""")
    worst: str = field("""str: The worst stage: the first that falls, or else stands only with self-stress, or
    is undecided, or else the one of the least margin.
    """)
    stages: int = field("""int: How many stages there are.""")
    stand_first: int = field("""int: How many stand, from the first on.""")
    stand: int = field("""int: How many stand in all.""")
    least_load_factor: LeastMargin | None = field("""LeastMargin or None: The stage of the least load factor of its live load, where any
    has one.
    """)
    least_tilt_deg: LeastMargin | None = field("""LeastMargin or None: The stage that falls at the least tilt, in degrees, where any
    was asked for it.
    """)
    most_held: int | None = field("""int or None: Of an order: the most blocks that are held at a time; absent where none
    was found.
    """)
    least_held: int | None = field("""int or None: Of an order: with fewer held at a time there is none, as far as the
    search went.
    """)
    hands: int | None = field("""int or None: Of an order: so many blocks can be held at a time, where that was said.""")
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly the verdicts are proved, the weakest of all;
    absent where one is undecided.
    """)


class WithoutKeys(Keys):
    """Keys of :class:`voussoir.Without`."""

    _place = "without"
    removable: list[str] = field("""list of str: The blocks without which the others stand.""")
    each: list[WithoutBlock] = field("""list of WithoutBlock: Every free block, in the order of the scene.""")
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly the verdicts are proved, the weakest of all;
    absent where one is undecided.
    """)


class StateKeys(Keys):
    """Keys of :class:`voussoir.State`."""

    _place = "state"
    verdict: Verdict = field("""Verdict: ``stable`` where the forces of the state balance every block; else the
    verdict that ``assess`` gives, ``undecided`` where forces exist and no state was
    found.
    """)
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly it is proved that it stands; absent where no
    state was found.
    """)
    quadrature: Literal["area", "corners"] = field("""{"area", "corners"}: Where joints with an area are integrated.

        * ``area``: Exactly, over the part that is pressed.
        * ``corners``: At the corners of each joint, with an even share of its area: the
          compliance of the state under dry friction of the other questions, three times too stiff
          against turning.
    """)
    residuals: Residuals | None = field("""Residuals or None: What is left of balance, of Signorini's and of Coulomb's
    conditions, the worst of all states.
    """)
    joint_states: list[JointState] = field("""list of JointState: What every joint does under the dead load.""", key="joints")
    greatest: Greatest | None = field("""Greatest or None: The greatest numbers of them.""")
    load_factor: PathFactor | None = field("""PathFactor or None: Along a live load: how far the path goes.""")
    control: Watched | None = field("""Watched or None: The point whose way the curve shows.""")
    events: list[Event] = field("""list of Event: What happens on the way.""")
    joints_at_end: list[JointState] = field("""list of JointState: What every joint does at the end of the path.""")
    members_at_end: list[MemberLine] = field("""list of MemberLine: The forces in the members at the end of the path; those under the
    dead load stand beside the answer.
    """)


class SimulationKeys(Keys):
    """Keys of :class:`voussoir.Simulation`."""

    fate: Literal["stands", "falls", "undecided"] = field("""{"stands", "falls", "undecided"}: Its fate.

        * ``stands``: It came to rest where it was.
        * ``falls``: A block moved by more than [``FALLEN``](base::tolerance::FALLEN) × its
          thickness and was still moving.
        * ``undecided``: Neither.
    """)
    verdict: Verdict | None = field("""Verdict or None: The verdict.""")
    law: Literal["associative", "coulomb"] | None = field("""{"associative", "coulomb"} or None: It stands: for which law of sliding. With
    ``associative`` forces exist, and whether the loads produce them was not asked.

        * ``associative``: A joint that slides opens by μ × the slip. Admissible forces are then
          enough to stand.
        * ``coulomb``: Dry friction: a joint slides without opening. Forces must also be such as
          the loads produce.
    """)
    equilibrium_error: Bracket | None = field("""Bracket or None: Bracket of the least equilibrium error, in multiples of gravity.""")
    part: Deciding | None = field("""Deciding or None: The part of the scene that decides, where it has several.""")
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly it is proved; nothing where it is undecided.""")


class ShakenKeys(Keys):
    """Keys of :class:`voussoir.Shaken`."""

    _place = "shaken"
    asked: ShakeOptions = field("""ShakeOptions: What was asked, with the record itself.""")
    toward: tuple[float, float, float] = field("""three numbers: Unit direction of the motion, horizontal.""")
    fate: Literal["rests", "moves", "overturns"] = field("""{"rests", "moves", "overturns"}: What became of it.

        * ``rests``: Everything came to rest.
        * ``moves``: Something still moved when the time was over.
        * ``overturns``: A block overturned or fell.
    """)
    overturned: str | None = field("""str or None: The first block that overturned or fell.""")
    overturned_at: float | None = field("""float or None: When, s.""")
    motions: list[ShakenBlock] = field("""list of ShakenBlock: Free blocks in scene order.""", key="blocks")
    fidelity: Literal["fast", "fine"] = field("""{"fast", "fine"}: Settings of the steps.

        * ``fast``: √(L/g) / 100, L the median block size, 20 substeps: to be trusted 3 % away
          from a critical parameter.
        * ``fine``: √(L/g) / 400, 20 substeps: to be trusted 1 % away from it.
    """)
    step: float = field("""float: A step, s.""")
    substeps: int = field("""int: Substeps of it.""")
    steps: int = field("""int: Steps taken.""")
    time: float = field("""float: Time simulated, s.""")
    stop: Literal["fallen", "rest", "horizon", "stopped", "broken"] = field("""{"fallen", "rest", "horizon", "stopped", "broken"}: Why it ended.

        * ``fallen``: A block had fallen.
        * ``rest``: Everything rested long enough.
        * ``horizon``: The horizon was reached.
        * ``stopped``: The caller wanted no more.
        * ``broken``: The engine's numbers were no longer finite.
    """)


class CombinationsKeys(Keys):
    """Keys of :class:`voussoir.Combinations`."""

    _place = "combinations"
    governing: str = field("""str: The name of the one that governs.""")
    each: list[InCombination] = field("""list of InCombination: Each, in the order of the scene.""", key="list")
    proof: Literal["exact"] | dict[str, Any] | None = field(""""exact" or dict or None: How exactly they are proved, the weakest of all; absent
    where one is undecided.
    """)


class MeetKeys(Keys):
    """Keys of :class:`voussoir.Meet`."""

    _place = "meet"
    vary: str = field("""str: JSON pointer of the number that varies.""")
    between: tuple[float, float] = field("""two numbers: The range.""")
    requirement: tuple[Literal["load_factor", "tilt_deg", "alpha0", "geometric_factor", "site"], float] | None = field("""tuple of {"load_factor", "tilt_deg", "alpha0", "geometric_factor", "site"} and float
    or None: What is required, of what.
    """, key="required")
    changes: list[MeetChange] = field("""list of MeetChange: The changes, in the order of the scan.""")
    throughout: bool | None = field("""bool or None: Without a change: whether it is met throughout; absent where that is open.""")
    complete: bool = field("""bool: Whether the scan reached the other end.""")
    scan: list[MeetPoint] = field("""list of MeetPoint: The scan: computed, not proved.""")
