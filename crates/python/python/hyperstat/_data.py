"""Plain objects and the data of a file that they are."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from numbers import Integral, Real
from os import PathLike, fspath
from typing import Any, ClassVar, Optional, Union

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError

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
    if value is None or isinstance(value, (str, bool, int, float)):
        return value.item() if isinstance(value, np.generic) else value
    to_data = getattr(value, "to_data", None)
    if to_data is not None and not isinstance(value, type):
        return to_data()
    if isinstance(value, np.ndarray) and not is_masked(value):
        return data(value.tolist())
    if isinstance(value, np.generic):
        return data(value.item())
    if isinstance(value, Mapping):
        return {str(name): data(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [data(inner) for inner in value]
    if isinstance(value, PathLike):
        return fspath(value)
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real):
        return float(value)
    raise ArgumentError(
        f"`{value!r}` is nothing that a file can hold",
        help="give numbers, texts, sequences and mappings of them, or parts such as `hyperstat.Beam`",
    )


def is_masked(value: Any) -> bool:
    """Whether it is an array some of whose entries are not there."""
    return isinstance(value, np.ma.MaskedArray) and bool(np.any(value.mask))


def ron(value: Any) -> str:
    """A part as it stands in a RON file, which is read in place of JSON too."""
    if isinstance(value, Part):
        given = {name: own for name, own in vars(value).items() if own is not None}
        fields = ", ".join(f"{value._words.get(name, name)}: {ron(own)}" for name, own in given.items())
        if value._kind in ("Fixed", "Spherical") and not fields:
            return value._kind
        return f"{value._kind or ''}({fields})"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(str(name))}: {ron(own)}" for name, own in value.items()) + "}"
    plain = data(value)
    if isinstance(plain, list):
        each = ", ".join(map(ron, value))
        vector = bool(plain) and all(isinstance(own, (int, float)) for own in plain)
        return f"({each})" if vector or isinstance(value, tuple) else f"[{each}]"
    return json.dumps(plain, ensure_ascii=False)


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
    holders = list(_holders(written))
    for field, table in (("section", "sections"), ("material", "materials")):
        # A name that a beam gives is that of another, even where it is not in the table: an included file
        # may have it, and if none has it that is a mistake to tell.
        given = {own for _, holder in holders for own in _each(holder.get(field)) if isinstance(own, str)}
        for body, holder in holders:
            own = holder.get(field)
            if isinstance(own, list):
                holder[field] = [_named(written, one, table, body, given) for one in own]
            elif own is not None:
                holder[field] = _named(written, own, table, body, given)
    return written


def _holders(written: Mapping[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """What may hold a section and a material: beams, frames and members, of groups too, with their bodies."""
    groups = written.get("groups")
    for owner in (written, *(groups.values() if isinstance(groups, dict) else ())):
        bodies = owner.get("bodies") if isinstance(owner, dict) else None
        for name, body in bodies.items() if isinstance(bodies, dict) else ():
            for own in body.values() if isinstance(body, dict) else ():
                members = own.get("members") if isinstance(own, dict) else None
                for holder in (own, *(members if isinstance(members, list) else ())):
                    if isinstance(holder, dict):
                        yield name, holder


def _each(own: Any) -> Sequence[Any]:
    return own if isinstance(own, list) else (own,)


def _named(written: dict[str, Any], own: Any, table: str, body: str, given: set[str]) -> Any:
    known = written.setdefault(table, {}) if isinstance(own, dict) else None
    # What is no table the loader tells.
    if not isinstance(own, dict) or not isinstance(known, dict):
        return own
    for name, other in known.items():
        if other == own:
            return name
    name, number = body, 1
    while name in known or name in given:
        number += 1
        name = f"{body}-{number}"
    known[name] = own
    return name
