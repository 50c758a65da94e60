"""Plain objects and the data of a file that they are."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from typing import Any, ClassVar, Optional, Union

import numpy as np
import numpy.typing as npt

Number = Union[float, str]
"""A number in SI units, or a text with a unit or an expression: `0.014`, `"14 mm"`, `"= 2 * R"`."""

Count = Union[int, str]
"""A whole number, or an expression."""

Numbers = Union[Sequence[Number], npt.NDArray[np.float64], str]
"""Several numbers, or an expression."""


class Part:
    """A part of a mechanism as plain data: what stands in a file under the same names."""

    _kind: ClassVar[Optional[str]] = None
    _words: ClassVar[Mapping[str, str]] = {}

    def _set(self, **fields: Any) -> None:
        for name, value in fields.items():
            setattr(self, name, value)

    def to_data(self) -> Any:
        """What stands in a JSON file.

        Returns
        -------
        dict or str
        """
        given = {name: value for name, value in vars(self).items() if value is not None}
        fields = {self._words.get(name, name): data(value) for name, value in given.items()}
        if self._kind is None:
            return fields
        if self._kind in ("Fixed", "Spherical") and not fields:
            return self._kind
        return {self._kind: fields}

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return bool(self.to_data() == other.to_data())

    def __hash__(self) -> int:
        return hash(dumps(self.to_data()))

    def __repr__(self) -> str:
        given = ((name, value) for name, value in vars(self).items() if value is not None)
        fields = ", ".join(f"{name}={value!r}" for name, value in given)
        return f"{type(self).__name__}({fields})"


def data(value: Any) -> Any:
    """A value as JSON has it: parts, arrays and paths by what they hold."""
    if isinstance(value, Part):
        return value.to_data()
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return {str(name): data(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [data(inner) for inner in value]
    if isinstance(value, PathLike):
        return fspath(value)
    return value


def dumps(value: Any, indent: str = "") -> str:
    """JSON with a field a line, so that messages can show the line that is meant."""
    if isinstance(value, dict) and value:
        inner = indent + "  "
        lines = (f"{inner}{json.dumps(name)}: {dumps(own, inner)}" for name, own in value.items())
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    if isinstance(value, list) and any(isinstance(own, (dict, list)) for own in value):
        inner = indent + "  "
        return "[\n" + ",\n".join(inner + dumps(own, inner) for own in value) + f"\n{indent}]"
    return json.dumps(value, ensure_ascii=False)


def with_names(fields: Mapping[str, Any]) -> dict[str, Any]:
    """The data of a mechanism file whose beams may hold their sections and materials themselves: those get
    names, as the file has them.
    """
    written: dict[str, Any] = data(fields)
    bodies = written.get("bodies")
    if not isinstance(bodies, dict):
        return written
    for name, body in bodies.items():
        for own in body.values() if isinstance(body, dict) else ():
            members = own.get("members") if isinstance(own, dict) else None
            for holder in (own, *(members if isinstance(members, list) else ())):
                _name(written, holder, "section", "sections", name)
                _name(written, holder, "material", "materials", name)
    return written


def _name(written: dict[str, Any], holder: Any, field: str, table: str, body: str) -> None:
    if not isinstance(holder, dict):
        return
    own = holder.get(field)
    if isinstance(own, list):
        holder[field] = [_named(written, one, table, body) for one in own]
    elif own is not None:
        holder[field] = _named(written, own, table, body)


def _named(written: dict[str, Any], own: Any, table: str, body: str) -> Any:
    if not isinstance(own, dict):
        return own
    known: dict[str, Any] = written.setdefault(table, {})
    for name, other in known.items():
        if other == own:
            return name
    name, number = body, 1
    while name in known:
        number += 1
        name = f"{body}-{number}"
    known[name] = own
    return name
