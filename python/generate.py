"""Write the classes for the keys of scenes and answers: ``python generate.py``, with the package
installed. ``--check`` compares only.

Names, types, units and meaning are those of ``voussoir schema``; examples are the shortest pieces
of the scenes in ``structures``. The tables below hold what a schema does not: names that Python has
for something else, where in a scene an object goes, and what methods take by position.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
PACKAGE = HERE / "package" / "voussoir"
STRUCTURES = HERE.parent / "structures"

Schema = dict[str, Any]

NAMES = {
    # Scenes.
    "BlockSpec": "Block",
    "ContactSpec": "ContactTolerances",
    "InterfaceSpec": "Interface",
    "JointOverride": "Joint",
    "Record": "Heading",
    "StageSpec": "Stage",
    # Answers.
    "Factor": "GeometricFactor",
    "Finding": "Note",
    "Grip2": "Grip",
    "JointAnswer": "JointState",
    "JointWords": "JointMotion",
    "Line2": "ThrustLine",
    "LoadFactorAnswer": "LoadFactor",
    "MechanismWords": "Mechanism",
    "MemberWords": "MemberMotion",
    "Reaction2": "StageReaction",
    "Simulation": "Simulated",
    "Standing2": "AxleOnSpan",
    "Without": "WithoutBlock",
}
# Where in a scene an object goes: a list, or the one value of a key.
UNDER = {
    "BlockSpec": "blocks",
    "Combination": "combinations",
    "ContactSpec": "contact",
    "InterfaceSpec": "interfaces",
    "JointOverride": "overrides",
    "Member": "members",
    "PushingMass": "masses",
    "Record": "record",
    "Requirements": "require",
    "Site": "site",
    "StageSpec": "stages",
    "Template": "templates",
    "Train": "train",
}
# Methods of `Scene`: the object that they make, parameters before its keys, keys taken by position,
# and what is done with it.
METHODS = {
    "joint": ("JointOverride", "", [], "self._joint({})"),
    "load": ("Load", 'kind: Literal["dead", "live"]', ["block"], "self._load(kind, {})"),
    "member": ("Member", "", ["id"], "self.add({})"),
    "interface": ("InterfaceSpec", "", ["between", "points"], "self.add({})"),
    "contact": ("ContactSpec", "", [], "self.add({})"),
    "material": ("Material", "name: str", ["density"], "self._material(name, {})"),
}
KIND = ["kind : str", "``dead`` loads always act; ``live`` loads are multiplied by the load factor."]
MORE = {"load": KIND, "material": ["name : str", "What blocks and templates call it."]}
JOINTS = "Without ``between`` and ``blocks`` it holds for all joints that have no rule of their own."
NOTES = {"joint": JOINTS}
# Shapes that `Block` has methods for; the first four `Scene`, too.
SHAPES = ["box", "sphere", "prism", "polyhedron", "mesh", "clump", "plane"]
# Answers, and the objects of the schema whose keys are theirs.
ANSWERS = {
    "Assessment": ["VerdictAnswer"],
    "Limit": ["LimitAnswer"],
    "Moving": ["MovingAnswer"],
    "Tilt": ["TiltAnswer"],
    "Thrust": ["ThrustAnswer"],
    "Path": ["PathAnswer"],
    "Kinematic": ["KinematicAnswer", "Numbers"],
    "Stages": ["StagesAnswer"],
    "Without": ["WithoutAnswer"],
    "State": ["StateAnswer"],
    "Simulation": ["SimulationAnswer"],
    "Shaken": ["ShakenAnswer"],
    "Combinations": ["CombinationsAnswer"],
    "Meet": ["MeetAnswer"],
}
# Keys that are arrays in Python, or whose name every answer has already.
BY_HAND = {"State": {"displacements", "frequencies", "curve"}}
RENAMED = {
    ("Combinations", "list"): "each",
    ("Meet", "required"): "requirement",
    ("Shaken", "blocks"): "motions",
    ("State", "joints"): "joint_states",
}
# Beside what answers hold themselves.
ALSO = ["CriticalResult", "CriticalValue", "PathResult", "StagesResult", "ThrustResult", "Simulation"]
ALSO += ["MechanismWords", "MemberLine", "Doubt", "Why", "Required", "Sensitivity"]
BASES = {"LoadFactor": "Number", "Bound": "Number"}
# Examples of those that the package shows: statements after those of the scene, and what they print.
TABLE = """>>> import voussoir
>>> table = voussoir.Scene("Table", friction=0.6, density=2400)
>>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
>>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
"""
PUSHED = TABLE + """>>> answer = voussoir.limit(table.load("live", weight=(1, 0, 0)))
"""
RECORD_EXAMPLES = {
    "LoadFactor": PUSHED + """>>> factor = answer.load_factor
>>> factor.status, factor.law, round(factor.value, 6), factor.lower <= factor.upper
('found', 'coulomb', 0.4, True)
>>> round(float(factor), 6), factor["status"]
(0.4, 'found')""",
    "Bound": PUSHED + """>>> bound = answer.load_factor.associative
>>> bound.status, bound.lower <= bound.value <= bound.upper
('found', True)""",
    "Bracket": TABLE + """>>> error = voussoir.assess(table).equilibrium_error
>>> error.lower, error.upper < 1e-9
(0.0, True)""",
    "CriticalValue": TABLE + """>>> friction = "/joints/default/friction"
>>> tilted = table.load("dead", weight=(0.3, 0, 0))
>>> (critical,) = voussoir.critical(tilted, friction, (0.1, 0.6), scan=4).values
>>> round(critical.value, 4), critical.below.value, critical.above.value
(0.3, 'unstable', 'stable')""",
    "Doubt": """>>> import voussoir
>>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
>>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=27))
>>> doubt = voussoir.assess(arch, time_limit=1e-9).doubt
>>> doubt.cause
'time_limit'""",
    "Mechanism": PUSHED + """>>> answer.mechanism.moving, len(answer.mechanism.joints)
(['block'], 1)""",
    "JointMotion": PUSHED + """>>> (joint,) = answer.mechanism.joints
>>> joint.between, joint.motion
(('ground', 'block'), 'hinge')""",
}


def schema(of: str) -> Schema:
    line = [sys.executable, "-m", "voussoir", "schema", of]
    text = subprocess.run(line, capture_output=True, text=True, check=True).stdout
    found: Schema = json.loads(text)
    return found


def name_of(definition: str) -> str:
    return NAMES.get(definition, definition)


def camel(key: str) -> str:
    return "".join(word.capitalize() for word in key.split("_"))


def said(node: Schema) -> str:
    """A description as a docstring has it."""
    text = " ".join(node.get("description", "").split())
    # Links into the code.
    text = re.sub(r" \(\[`\w+`\](\([\w:]+\))?\)", "", text)
    return re.sub(r"`+([^`]*)`+", r"``\1``", text)


def wrapped(text: str, indent: str) -> list[str]:
    return textwrap.wrap(text, 92, initial_indent=indent, subsequent_indent=indent)


def quoted(lines: list[str], indent: str) -> str:
    """A docstring of these lines."""
    if len(lines) == 1 and len(indent + lines[0]) < 94:
        return f'{indent}"""{lines[0]}"""'
    first, *rest = wrapped(lines[0], indent + "   ")
    body = [indent + '"""' + first.strip(), *(indent + line.strip() for line in rest)]
    body += [indent + line if line else "" for line in lines[1:]]
    return "\n".join([*body, f'{indent}"""'])


class Kind:
    """What Python takes or gives for a node of a schema."""

    def __init__(self, python: str, words: str, choices: list[Schema] | None = None) -> None:
        self.python = python
        self.words = words
        self.choices = choices or []


class Schemas:
    """A schema and the names of its definitions; ``given`` where users write it."""

    def __init__(self, whole: Schema, given: bool) -> None:
        self.defs: dict[str, Schema] = whole["$defs"]
        self.given = given

    def kind(self, node: Schema) -> Kind:
        if "$ref" in node:
            name = node["$ref"].split("/")[-1]
            return self.named(name, self.defs[name])
        options = [o for o in options_of(node) if o.get("type") != "null"]
        if options:
            return self.either(options)
        if "const" in node:
            return Kind(f'Literal["{node["const"]}"]', f'"{node["const"]}"')
        types = node.get("type")
        kind = next((t for t in types if t != "null"), None) if isinstance(types, list) else types
        if kind == "array":
            return self.array(node)
        if kind == "object" and isinstance(node.get("additionalProperties"), dict):
            inner = self.kind(node["additionalProperties"])
            return Kind(f"dict[str, {inner.python}]", f"dict of names to {inner.words}")
        plain = {"number": "float", "integer": "int", "boolean": "bool", "string": "str"}
        word = plain.get(str(kind))
        return Kind(word, word) if word else Kind("dict[str, Any]", "dict")

    def array(self, node: Schema) -> Kind:
        if "prefixItems" in node:
            items = [self.kind(item) for item in node["prefixItems"]]
            python = f"tuple[{', '.join(i.python for i in items)}]"
            return Kind(python, "tuple of " + " and ".join(i.words for i in items))
        inner, count = node["items"], node.get("maxItems")
        item = self.kind(inner)
        if count is not None and count == node.get("minItems"):
            if self.given:
                python = "Vector" if item.python == "float" else f"Sequence[{item.python}]"
            else:
                python = f"tuple[{', '.join([item.python] * count)}]"
            numbers = {2: "two", 3: "three"}.get(count, str(count))
            words = f"{numbers} numbers" if item.python == "float" else f"{numbers} of {item.words}"
            return Kind(python, words)
        if self.given and inner.get("type") == "array" and inner["items"].get("type") == "number":
            return Kind("npt.ArrayLike", f"array of shape (n, {inner['maxItems']})")
        return Kind(f"{'Sequence' if self.given else 'list'}[{item.python}]", f"list of {item.words}")

    def named(self, name: str, node: Schema) -> Kind:
        if name == "Verdict":
            return Kind("Verdict", "Verdict")
        if "properties" in node and "anyOf" not in node:
            return Kind(name_of(name), name_of(name))
        if name in ("Answer", "Told"):
            # Of any question.
            return Kind("dict[str, Any]", "dict")
        return self.kind(node)

    def either(self, options: list[Schema]) -> Kind:
        if all(isinstance(o.get("const"), str) for o in options):
            words = ", ".join(f'"{o["const"]}"' for o in options)
            choices = options if any("description" in o for o in options) else []
            return Kind(f"Literal[{words}]", "{" + words + "}", choices)
        if all(tag(o) for o in options):
            if not self.given:
                return Kind("dict[str, Any]", "dict")
            kinds = [Kind(c, c) for c in (self.tagged(o)[0] for o in options)]
        else:
            kinds = [self.kind(o) for o in options]
        pythons = dict.fromkeys(k.python for k in kinds)
        texts = dict.fromkeys(k.words for k in kinds)
        return Kind(" | ".join(pythons), " or ".join(texts), [c for k in kinds for c in k.choices])

    def tagged(self, option: Schema) -> tuple[str, Schema]:
        """The class of a choice that is named by its key, and what it holds."""
        key = str(tag(option))
        inner = option["properties"][key]
        if "$ref" in inner:
            definition = inner["$ref"].split("/")[-1]
            return name_of(definition), self.defs[definition]
        return camel(key), inner


def options_of(node: Schema) -> list[Schema]:
    found: list[Schema] = node.get("oneOf") or node.get("anyOf") or []
    return found


def tag(option: Schema) -> str | None:
    keys = list(option.get("properties", {}))
    is_tagged = len(keys) == 1 and option.get("required") == keys
    return keys[0] if is_tagged else None


class Field:
    """A key of an object."""

    def __init__(self, schemas: Schemas, key: str, node: Schema, required: bool) -> None:
        self.key, self.node, self.required = key, node, required
        self.kind = schemas.kind(node)
        types = node.get("type")
        nothing = isinstance(types, list) and "null" in types
        nothing |= any(o.get("type") == "null" for o in node.get("anyOf", []))
        self.default: str | None = None
        empty = None if nothing else {"boolean": "False", "array": "[]", "object": "{}"}.get(str(types))
        if not required:
            given = "False" if empty == "False" else "None"
            self.default = given if schemas.given else (empty or "None")
        optional = self.default == "None"
        self.python = self.kind.python + (" | None" if optional else "")
        self.words = self.kind.words + (", optional" if self.default and schemas.given else "")
        self.words += " or None" if optional and not schemas.given else ""

    def documented(self) -> list[str]:
        lines = [f"{self.key} : {self.words}"]
        text = said(self.node)
        if isinstance(self.node.get("default"), float):
            text = f"{text.rstrip('.')}. Default {self.node['default']:g}."
        return lines + wrapped(text, "    ") + listed(self.kind.choices)


def listed(choices: list[Schema]) -> list[str]:
    lines = []
    for option in choices:
        first, *rest = wrapped(f"* ``{option['const']}``: {said(option)}", "    ")
        lines += [first, *("  " + line for line in rest)]
    return ["", *lines, ""] if lines else []


def fields_of(schemas: Schemas, node: Schema) -> list[Field]:
    required = node.get("required", [])
    return [Field(schemas, k, n, k in required) for k, n in node.get("properties", {}).items()]


def section(title: str, fields: list[Field]) -> list[str]:
    lines = [line for f in fields for line in f.documented()]
    return ["", title, "-" * len(title), *lines] if fields else []


def tidy(lines: list[str]) -> list[str]:
    """Without empty lines at the end or beside each other."""
    kept = [l for l, before in zip(lines, ["x", *lines]) if l or before]
    while kept and not kept[-1]:
        kept.pop()
    return kept


# -------------------------------------------------------------------- examples


class Examples:
    """The shortest instance of every class in the scenes of the repository."""

    def __init__(self, schemas: Schemas, whole: Schema) -> None:
        self.schemas = schemas
        self.found: dict[str, Schema] = {}
        for path in sorted(STRUCTURES.glob("*.json")):
            scene = json.loads(path.read_text(encoding="utf-8"))
            if isinstance(scene, dict) and scene.get("format") == "voussoir-scene/1":
                self.look(whole, scene)

    def keep(self, name: str, node: Schema, value: Any) -> None:
        old = self.found.get(name)
        if old is None or len(json.dumps(value)) < len(json.dumps(old)):
            self.found[name] = value
        for key, inner in node.get("properties", {}).items():
            if key in value:
                self.look(inner, value[key])

    def look(self, node: Schema, value: Any) -> None:
        if "$ref" in node:
            name = node["$ref"].split("/")[-1]
            definition = self.schemas.defs[name]
            if "properties" in definition and isinstance(value, dict):
                self.keep(name_of(name), definition, value)
            else:
                self.look(definition, value)
            return
        for option in options_of(node):
            key = tag(option)
            if key and isinstance(value, dict) and key in value:
                self.keep(*self.schemas.tagged(option), value[key])
            elif isinstance(value, dict) and "$ref" in option:
                self.look(option, value)
        if isinstance(value, list):
            for item in value:
                self.look(node.get("items", {}), item)
        elif isinstance(value, dict):
            for key, inner in value.items():
                more = node.get("additionalProperties")
                kind = node.get("properties", {}).get(key, more if isinstance(more, dict) else {})
                self.look(kind, inner)

    def call(self, name: str, node: Schema, value: Any) -> str:
        keys = node["properties"]
        inner = [f"{key}={self.code(keys[key], v)}" for key, v in value.items()]
        return f"voussoir.{name}({', '.join(inner)})"

    def code(self, node: Schema, value: Any) -> str:
        if "$ref" in node:
            name = node["$ref"].split("/")[-1]
            definition = self.schemas.defs[name]
            if "properties" in definition and isinstance(value, dict):
                return self.call(name_of(name), definition, value)
            return self.code(definition, value)
        for option in options_of(node):
            if not isinstance(value, dict):
                if isinstance(value, list) == (option.get("type") == "array"):
                    return self.code(option, value)
            elif (key := tag(option)) and key in value:
                return self.call(*self.schemas.tagged(option), value[key])
            elif "$ref" in option:
                return self.code(option, value)
        if isinstance(value, list):
            inner = [self.code(node.get("items", {}), v) for v in value]
            return f"({', '.join(inner)})" if "maxItems" in node else f"[{', '.join(inner)}]"
        return json.dumps(value) if isinstance(value, str) else repr(value)

    def of(self, name: str, node: Schema, under: str | None) -> list[str]:
        value = self.found[name] if name in self.found else BY_VALUE[name]
        lines = ["", "Examples", "--------", ">>> import voussoir"]
        lines += prompted(f"{name.lower()} = {self.call(name, node, value)}")
        if under in ("blocks", "templates"):
            counts = "1 block" if under == "blocks" else "0 blocks, 1 template"
            lines += [f">>> voussoir.Scene().add({name.lower()})", f"<voussoir.Scene {counts}>"]
            return lines
        lines += [f">>> scene = voussoir.Scene().add({name.lower()})"] if under else []
        key = next(iter(value))
        shown = self.code(node["properties"][key], value[key]).replace("voussoir.", "")
        return lines + [f">>> {name.lower()}.{key}", shown.replace('"', "'")]


# Where no scene of the repository has one.
ENDS = [{"block": "pier", "at": [0, 0, 3]}, {"ground": [4, 0, 0]}]
BALLS = [{"at": [0, 0, 0], "radius": 0.01}, {"at": [0.012, 0, 0], "radius": 0.008}]
BY_VALUE: dict[str, Schema] = {
    "Ball": BALLS[0],
    "Bar": {"between": ENDS, "tension": 20_000, "compression": 5_000},
    "Building": {"t_1": 0.4, "storeys": 3, "height": 10.5, "z": 7},
    "Clump": {"spheres": BALLS},
    "ContactTolerances": {"gap": 0.001, "angle_deg": 2},
    "Dowel": {"blocks": ["v03", "v04"], "at": [1, 0, 2], "strength": 8_000},
    "Heading": {"project": "Mill Lane", "author": "A. Mason", "revision": "B"},
    "Lattice": {"packing": "square", "radius": 0.05, "layers": 3, "material": "glass"},
    "Near": {"near": [0, 0.15, 3]},
    "Plane": {"normal": [0, 0, 1]},
    "PushingMass": {"block": "wall", "at": [0, 0.1, 3], "mass": 1200},
    "Soil": {
        "block": "abutment",
        "face": "left",
        "direction": [1, 0, 0],
        "surface": 3,
        "unit_weight": 18_000,
        "k": 3,
    },
    "Strip": {"blocks": ["v00", "v01", "v02"], "face": "intrados", "width": 0.1, "strength": 40_000},
    "Tendon": {"through": ENDS, "strength": 100_000, "prestress": 30_000},
    "Toothing": {
        "block": "wall",
        "courses": 8,
        "block_height": 0.2,
        "overlap": 0.15,
        "friction": 0.5,
        "thickness": 0.3,
        "unit_weight": 18_000,
        "height": 1.6,
        "direction": [0, 1, 0],
    },
}


def prompted(code: str) -> list[str]:
    """An example of one statement: a line, or an argument a line."""
    if len(code) <= 88:
        return [f">>> {code}"]
    lines, depth, line = [], 0, ""
    for c in code:
        line += c
        depth += (c in "([") - (c in ")]")
        if depth == 1 and c in "(,":
            lines.append(line.strip())
            line = ""
    lines.append(line.strip())
    head, *rest, last = lines
    tail = last[:-1]
    body = [f">>> {head}", *(f"...     {r}" for r in rest)]
    body += [f"...     {tail},"] if tail else []
    return [*body, "... )"]


# ---------------------------------------------------------------------- scenes


def scene_module(whole: Schema) -> str:
    schemas = Schemas(whole, given=True)
    examples = Examples(schemas, whole)
    classes: dict[str, tuple[Schema, str, str | None, str | None]] = {}

    def visit(node: Any) -> None:
        if isinstance(node, list):
            for inner in node:
                visit(inner)
        elif isinstance(node, dict):
            if "$ref" in node:
                take(node["$ref"].split("/")[-1])
            for inner in node.values():
                visit(inner)

    def take(definition: str) -> None:
        node, name = schemas.defs[definition], name_of(definition)
        options = node.get("oneOf", [])
        if options and all(tag(o) for o in options):
            for option in options:
                cls, inner = schemas.tagged(option)
                if cls not in classes:
                    classes[cls] = (inner, said(option), tag(option), UNDER.get(definition))
                    visit(inner)
        elif "properties" in node and name not in classes:
            classes[name] = (node, said(node), None, UNDER.get(definition))
            visit(node)
        elif "properties" not in node:
            visit(node)

    # `joint`, `load` and `material` of a scene take the place of what only holds them.
    visit({k: v for k, v in whole["properties"].items() if k not in ("joints", "loads", "materials")})
    for definition in ("Material", "JointOverride", "Load", "PushingMass"):
        take(definition)

    parts = [HEAD.format(what="scenes", imports=SCENE_IMPORTS, all=exported(list(classes)))]
    for name, (node, text, key, under) in classes.items():
        fields = fields_of(schemas, node)
        doc = tidy([text, *section("Parameters", fields), *examples.of(name, node, under)])
        lines = ["@dataclass(frozen=True, kw_only=True, eq=False, repr=False)", f"class {name}(Value):"]
        lines += [quoted(doc, "    "), ""]
        lines += [f'    _tag: ClassVar[str | None] = "{key}"'] if key else []
        lines += [f'    _under: ClassVar[str | None] = "{under}"'] if under else []
        lines += [
            f"    {f.key}: {f.python}" + (f" = {f.default}" if f.default else "") for f in fields
        ]
        if name == "Block":
            lines += shapes(schemas, fields, "Block")
        parts.append("\n".join(lines))
    block = fields_of(schemas, schemas.defs["BlockSpec"])
    lines = ["class SceneMethods:", '    """What is added to a scene by the keys of its file."""']
    lines += ["", "    if TYPE_CHECKING:", ""]
    for stub in ("add(self, *things: Value)", "_joint(self, rule: Joint)"):
        lines.append(f"        def {stub} -> Self: ...")
    for stub in ("_load(self, kind: str, load: Load)", "_material(self, name: str, values: Material)"):
        lines.append(f"        def {stub} -> Self: ...")
    lines += shapes(schemas, block, "Self")
    for method, (definition, before, placed, body) in METHODS.items():
        node = schemas.defs[definition]
        fields = fields_of(schemas, node)
        doc = [*([said(node)] if said(node) else [f"Add a {method}."]), ""]
        doc += [NOTES[method], ""] if method in NOTES else []
        doc += ["Parameters", "----------"]
        doc += [MORE[method][0], "    " + MORE[method][1]] if method in MORE else []
        doc += section("Parameters", fields)[3:]
        lines += signature(method, "self", before, fields, placed, "Self")
        values = ", ".join(f"{f.key}={f.key}" for f in fields)
        lines += [quoted(tidy(doc), " " * 8)]
        lines += call(body, name_of(definition), values)
    parts.append("\n".join(lines))
    return "\n\n\n".join(parts) + "\n"


def shapes(schemas: Schemas, block: list[Field], result: str) -> list[str]:
    """A method for each shape of a block."""
    lines = []
    by_class = result == "Block"
    rest = [f for f in block if f.key not in ("id", "shape")]
    for option in schemas.defs["Shape"]["oneOf"]:
        cls, node = schemas.tagged(option)
        key = str(tag(option))
        if key not in (SHAPES if by_class else SHAPES[:4]):
            continue
        own = fields_of(schemas, node)
        first = next(f for f in block if f.key == "id")
        needed = [f for f in own if f.required]
        fields = [first, *needed, *rest, *(f for f in own if not f.required)]
        placed = ["id", *(f.key for f in needed), "at"]
        if by_class:
            lines += ["", "    @classmethod"]
            lines += signature(key, "cls", "", fields, placed, result)[1:]
        else:
            lines += signature(key, "self", "", fields, placed, result)
        text = said(option)
        doc = [text, *section("Parameters", fields)] if by_class else [f"Add :meth:`Block.{key}`: {text[0].lower()}{text[1:]}"]
        lines += [quoted(tidy(doc), " " * 8)]
        if by_class:
            shape = f"{cls}({', '.join(f'{f.key}={f.key}' for f in own)})"
            values = f"id=id, shape={shape}, " + ", ".join(f"{f.key}={f.key}" for f in rest)
            lines += call("{}", "cls", values)
        else:
            values = ", ".join(f"{f.key}={f.key}" for f in fields)
            lines += call("self.add({})", f"Block.{key}", values)
    return lines


def call(body: str, name: str, values: str) -> list[str]:
    before, after = body.split("{}")
    made = textwrap.wrap(values + ",", 96, initial_indent=" " * 12, subsequent_indent=" " * 12)
    return [f"        return {before}{name}(", *made, f"        ){after}"]


def signature(
    name: str, first: str, before: str, fields: list[Field], placed: list[str], result: str
) -> list[str]:
    by_place = [f for f in fields if f.key in placed]
    by_name = sorted((f for f in fields if f.key not in placed), key=lambda f: not f.required)
    lines = ["", f"    def {name}(", f"        {first},"]
    lines += [f"        {before},"] if before else []

    def one(f: Field) -> str:
        return f"        {f.key}: {f.python}" + (f" = {f.default}," if f.default else ",")

    lines += [one(f) for f in by_place]
    lines += ["        *,", *(one(f) for f in by_name)] if by_name else []
    return [*lines, f"    ) -> {result}:"]


# --------------------------------------------------------------------- answers


def answer_module(whole: Schema) -> str:
    schemas = Schemas(whole, given=False)
    places = {}
    for option in schemas.defs["Answer"]["anyOf"]:
        key = tag(option)
        inner = option["properties"][key] if key else {}
        if "$ref" in inner:
            places[inner["$ref"].split("/")[-1]] = key
    names: dict[str, str] = {}

    def visit(node: Any) -> None:
        if isinstance(node, list):
            for inner in node:
                visit(inner)
        elif isinstance(node, dict):
            if "$ref" in node:
                take(node["$ref"].split("/")[-1])
            for inner in node.values():
                visit(inner)

    def take(definition: str) -> None:
        node = schemas.defs[definition]
        if definition in names or definition in ("Verdict", "Answer", "Told"):
            return
        if schemas.kind({"$ref": f"#/$defs/{definition}"}).python == name_of(definition):
            names[definition] = name_of(definition)
            visit(node)
        elif not all(tag(o) for o in node.get("oneOf", [{}])):
            visit(node)

    for definitions in ANSWERS.values():
        for definition in definitions:
            visit(schemas.defs[definition])
    for definition in ALSO:
        take(definition)
    parts = [HEAD.format(what="answers", imports=ANSWER_IMPORTS, all=exported([*names.values(), *(f"{a}Keys" for a in ANSWERS)]))]
    for definition, name in names.items():
        fields = fields_of(schemas, schemas.defs[definition])
        doc = tidy([said(schemas.defs[definition]) or f"{name}.", *section("Attributes", fields)])
        if name in RECORD_EXAMPLES:
            doc += ["", "Examples", "--------", *RECORD_EXAMPLES[name].splitlines()]
        lines = [f"class {name}({BASES.get(name, 'Record')}):"]
        lines += [quoted(doc, "    "), "", *(f"    {f.key}: {f.python}" for f in fields)]
        parts.append("\n".join(lines))
    for answer, definitions in ANSWERS.items():
        place = places.get(definitions[0])
        lines = [f"class {answer}Keys(Keys):", f'    """Keys of :class:`voussoir.{answer}`."""']
        lines += ["", *([f'    _place = "{place}"'] if place else [])]
        for k, definition in enumerate(definitions):
            for f in fields_of(schemas, schemas.defs[definition]):
                if f.key in BY_HAND.get(answer, ()):
                    continue
                key = RENAMED.get((answer, f.key), f.key)
                # A scene that does not stand has other keys.
                optional = " | None" if answer == "Thrust" and "None" not in f.python else ""
                more = ['within="numbers"'] if k else []
                more += [f'key="{f.key}"'] if key != f.key else []
                meaning = f"{f.words}: {said(f.node)}"
                text = quoted(tidy([meaning, *listed(f.kind.choices)]), "    ").strip()
                given = ", ".join([text, *more])
                lines += [f"    {key}: {f.python}{optional} = field({given})"]
        parts.append("\n".join(lines))
    return "\n\n\n".join(parts) + "\n"


def exported(names: list[str]) -> str:
    return "__all__ = [\n" + "".join(f'    "{name}",\n' for name in sorted(names)) + "]"


HEAD = '''"""The keys of {what}. Made by ``python/generate.py`` from ``voussoir schema``: not to be edited."""

from __future__ import annotations

{imports}

{all}'''

SCENE_IMPORTS = """from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy.typing as npt

from ._plain import Value, Vector

if TYPE_CHECKING:
    from typing import Self"""

ANSWER_IMPORTS = """from typing import Any, Literal

from ._record import Keys, Number, Record, Verdict, field"""


def made() -> Iterator[tuple[Path, str]]:
    yield PACKAGE / "_scene_keys.py", scene_module(schema("scene"))
    yield PACKAGE / "_answer_keys.py", answer_module(schema("result"))


def main() -> int:
    stale = 0
    for path, text in made():
        if "--check" not in sys.argv:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            print(f"{path.name} is not what the schema says: run python/generate.py")
            stale = 1
    return stale


if __name__ == "__main__":
    sys.exit(main())
