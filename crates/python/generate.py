"""Writes `python/hyperstat/parts.py`, the classes of what may stand in a file, from the JSON Schema.

    python crates/python/generate.py [SCHEMA.json]

Without a schema it takes that of the package that is installed. A test holds the file to it.
"""

from __future__ import annotations

import json
import keyword
import sys
import textwrap
from pathlib import Path
from typing import Any

HEAD = '''"""What may stand in a file, as plain objects: materials, sections, bodies, joints, loads, prebuilt mechanisms.

Fields have the names that they have in a file, in SI units and global axes; what is a word of Python has a `_`
behind it (`from_`, `yield_`). A number may be a text with a unit or an expression. Nothing is checked here: the
loader checks it, when a mechanism is made of it.

Written by `generate.py` from the schema of files.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Literal, Optional, Union

from ._data import Count, Number, Numbers, Part
from ._mechanism import Prebuilt
'''

# Records whose objects have a class of their own, by their names in the schema.
RECORDS = {
    "material": "Material",
    "link": "Link",
    "leg": "Leg",
    "rails": "Rails",
    "load": "Load",
    "mass": "Mass",
    "joint": "Joint",
    "misfit": "Misfit",
    "preload": "Preload",
    "stiffnesses": "Stiffness",
    "member": "Member",
    "modes": "Modes",
    "group": "Group",
    "copies": "Copies",
    "mount": "Mount",
}
KINDS = ["section", "profile", "joint_kind", "body", "placing"]
PREBUILT = "job_mechanism"

# What a body or a member may hold itself, where a file has a name.
BEAMS = ("Beam", "Frame", "Member")
HELD = {"section": "profile", "material": "material"}


def kinds_of(definition: dict[str, Any]) -> dict[str, Any]:
    """Objects by the name of their kind."""
    if "properties" in definition:
        return dict(definition["properties"])
    for choice in definition.get("anyOf", []):
        if "properties" in choice:
            return dict(choice["properties"])
    return {}


class Writer:
    """Writes classes of a schema."""

    def __init__(self, schema: dict[str, Any]) -> None:
        self.definitions = schema["$defs"]
        self.classes: dict[str, str] = {}

    def all(self) -> str:
        for name in KINDS:
            for kind, own in kinds_of(self.definitions[name]).items():
                if "properties" in own:
                    self.add(kind, own, kind, "Part")
        for name, title in RECORDS.items():
            self.add(title, self.definitions[name], None, "Part")
        for kind, own in kinds_of(self.definitions[PREBUILT]).items():
            if "properties" in own:
                self.add(kind, own, kind, "Prebuilt")
        names = "".join(f'    "{name}",\n' for name in sorted(self.classes))
        return HEAD + f"\n__all__ = [\n{names}]\n" + "".join(self.classes.values())

    def add(self, title: str, own: dict[str, Any], kind: str | None, base: str) -> None:
        if title in self.classes:
            return
        required = own.get("required", [])
        fields = sorted(own["properties"].items(), key=lambda field: field[0] not in required)
        fields = [field for field in fields if field[0] != "$schema"]
        words = {python(name): name for name, _ in fields if python(name) != name}
        lines = [f"\n\nclass {title}({base}):", *docstring(own, fields, required, base)]
        if kind is not None:
            lines.append(f'    _kind: ClassVar[Optional[str]] = "{kind}"')
        if words:
            lines.append(f"    _words: ClassVar[Mapping[str, str]] = {json.dumps(words)}")
        lines += ["", "    def __init__(", "        self,"]
        if fields:
            lines.append("        *,")
        for name, value in fields:
            hint = self.hint(value)
            if title in BEAMS and name in HELD:
                hint = self.held(self.reference(HELD[name]), many="Sequence" in hint)
            if name in required:
                lines.append(f"        {python(name)}: {hint},")
            else:
                lines.append(f"        {python(name)}: {optional(hint)} = None,")
        lines.append("    ) -> None:")
        given = [f"            {python(name)}={python(name)}," for name, _ in fields]
        lines += ["        self._set(", *given, "        )"] if given else ["        self._set()"]
        self.classes[title] = "\n".join(lines) + "\n"

    def hint(self, value: dict[str, Any]) -> str:
        """The type of a field."""
        if "$ref" in value:
            return self.reference(value["$ref"].rsplit("/", 1)[1])
        if "enum" in value:
            return "Literal[" + ", ".join(json.dumps(word) for word in value["enum"]) + "]"
        if "anyOf" in value:
            return self.any_of(value["anyOf"])
        kind = value.get("type")
        if kind in ("boolean", "string", "number", "integer"):
            return {"boolean": "bool", "string": "str", "number": "Number", "integer": "Count"}[kind]
        if kind == "array":
            items = value.get("items")
            if isinstance(items, dict):
                inner = self.hint(items)
                return "Numbers" if inner == "Number" else f"Sequence[{inner}]"
            first = [self.hint(item) for item in value.get("prefixItems", [])]
            if first and all(own == "Number" for own in first):
                return "Numbers"
            return f"tuple[{', '.join(first)}]" if first else "Sequence[Any]"
        if kind == "object" and isinstance(value.get("additionalProperties"), dict):
            return f"Mapping[str, {self.hint(value['additionalProperties'])}]"
        return "Any"

    def any_of(self, choices: list[dict[str, Any]]) -> str:
        hints: list[str] = []
        for choice in choices:
            hint = "expression" if "pattern" in choice else self.hint(choice)
            if hint not in hints:
                hints.append(hint)
        if "Number" in hints or "Count" in hints or "Numbers" in hints:
            hints = [hint for hint in hints if hint != "expression"]
        hints = ["str" if hint == "expression" else hint for hint in hints]
        if "Any" in hints:
            return "Any"
        return hints[0] if len(hints) == 1 else f"Union[{', '.join(hints)}]"

    def held(self, hint: str, many: bool) -> str:
        """The type of a name, or of what it stands for; of many where there may be a list."""
        inner = hint.removeprefix("Union[").removesuffix("]")
        one = f"Union[str, {inner}]"
        return f"Union[str, {inner}, Sequence[{one}]]" if many else one

    def reference(self, name: str) -> str:
        if name in RECORDS:
            return RECORDS[name]
        if name in KINDS:
            definition = self.definitions[name]
            kinds = [kind for kind, own in kinds_of(definition).items() if "properties" in own]
            words = [own for own in definition.get("anyOf", []) if "enum" in own]
            return f"Union[{', '.join(kinds + [self.hint(own) for own in words])}]"
        return "Any"


def python(name: str) -> str:
    """A name that Python takes."""
    return name + "_" if keyword.iskeyword(name) else name


def optional(hint: str) -> str:
    return "Any" if hint == "Any" else f"Optional[{hint}]"


def docstring(
    own: dict[str, Any], fields: list[tuple[str, Any]], required: list[str], base: str
) -> list[str]:
    about = own.get("description", "A part")
    about = about[0].upper() + about[1:] + "."
    lines = [f'    """{about}']
    if fields:
        lines += ["", "    Parameters", "    ----------"]
    for name, value in fields:
        note = "" if name in required else " : optional"
        lines.append(f"    {python(name)}{note}")
        words = value.get("description", "")
        lines += textwrap.wrap(words, 100, initial_indent=" " * 8, subsequent_indent=" " * 8)
    lines.append('    """' if fields else '    """')
    return lines if fields else [f'    """{about}"""']


def written(schema: str) -> str:
    """The text of the file."""
    return Writer(json.loads(schema)).all()


if __name__ == "__main__":
    if len(sys.argv) > 1:
        text = Path(sys.argv[1]).read_text(encoding="utf-8")
    else:
        import hyperstat

        text = hyperstat.schema()
    target = Path(__file__).parent / "python" / "hyperstat" / "parts.py"
    target.write_text(written(text), encoding="utf-8")
