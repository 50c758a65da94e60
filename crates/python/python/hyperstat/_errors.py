"""What is wrong, where, and what would be right."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Optional


@dataclass(frozen=True)
class Place:
    """A place in the input.

    Attributes
    ----------
    path : str
        The file, or the name of the argument that was handed in.
    line, column : int
        From 1; 0 where the whole of an argument is meant.
    width : int
        Number of characters that are meant.
    text : str
        The line.
    """

    path: str
    line: int
    column: int
    width: int
    text: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}:{self.column}" if self.line else self.path


class Error(Exception):
    """Whatever hyperstat cannot do.

    Attributes
    ----------
    message : str
        What is wrong.
    place : Place or None
        Where the input says so.
    help : str or None
        What would be right.
    code : str
        A word for the kind of error that stays when messages change.
    """

    def __init__(
        self,
        message: str,
        *,
        code: str = "error",
        help: Optional[str] = None,
        place: Optional[Place] = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.code = code
        self.help = help
        self.place = place

    def __reduce__(self) -> tuple[object, ...]:
        return _again, (type(self), self.message, self.code, self.help, self.place)

    def __str__(self) -> str:
        lines = [self.message]
        if self.place is not None:
            lines[0] = f"{self.place}: {self.message}"
            if self.place.line and self.place.text:
                mark = " " * (self.place.column - 1) + "^" * self.place.width
                lines += [f"  | {self.place.text}", f"  | {mark}"]
        if self.help:
            lines.append(f"  help: {self.help}")
        return "\n".join(lines)


class InputError(Error, ValueError):
    """A file, a text or an object that means nothing, with the place of the first mistake."""


class ArgumentError(Error, ValueError):
    """An argument of a call that is wrong."""

    def __init__(
        self,
        message: str,
        *,
        code: str = "argument",
        help: Optional[str] = None,
        place: Optional[Place] = None,
    ) -> None:
        super().__init__(message, code=code, help=help, place=place)


class SelectionError(Error, KeyError):
    """A job, design, pose, case or column that there is not."""


class PoseError(Error, ValueError):
    """A pose that the mechanism cannot take, where one alone is asked for."""


class UnsolvableError(Error, ArithmeticError):
    """A mechanism that has no solution: it is not held, a load acts on a free motion, ..."""


class MissingError(Error, ImportError):
    """A package that is not installed."""

    def __init__(
        self,
        message: str,
        *,
        code: str = "missing-package",
        help: Optional[str] = None,
        place: Optional[Place] = None,
    ) -> None:
        super().__init__(message, code=code, help=help, place=place)


class RunError(Error, RuntimeError):
    """A run whose parts are not as they should be, or whose files cannot be written."""


class InternalError(Error, RuntimeError):
    """A bug in hyperstat."""


_CLASSES: dict[str, type[Error]] = {
    "input": InputError,
    "same-column": InputError,
    "not-adjusted": InputError,
    "argument": ArgumentError,
    "no-derivative": ArgumentError,
    "no-batch": SelectionError,
    "job-not-chosen": SelectionError,
    "unknown-job": SelectionError,
    "unknown-pose": SelectionError,
    "unknown-design": SelectionError,
    "unknown-case": SelectionError,
    "unreachable": PoseError,
    "singular": PoseError,
    "branch": PoseError,
    "pose": PoseError,
    "unrestrained": UnsolvableError,
    "too-large": UnsolvableError,
    "misfit": UnsolvableError,
    "no-mass": UnsolvableError,
    "unsolvable": UnsolvableError,
    "free-output": UnsolvableError,
    "unverified": UnsolvableError,
    "parts": RunError,
    "output": RunError,
    "internal": InternalError,
}


def make(
    code: str,
    message: str,
    help: Optional[str],
    place: Optional[tuple[str, int, int, int, str]],
) -> Error:
    """The error of a code, for the core."""
    at = None if place is None else Place(*place)
    return _CLASSES.get(code, Error)(message, code=code, help=help, place=at)


def unknown(what: str, name: object, known: Iterable[str], code: str) -> SelectionError:
    """The error of a name that there is not."""
    names = list(known)
    near = get_close_matches(str(name), names, 1)
    shown = ", ".join(names[:40]) + (", ..." if len(names) > 40 else "")
    help = f"did you mean `{near[0]}`?" if near else f"there are {shown or 'none'}"
    return SelectionError(f"there is no {what} `{name}`", code=code, help=help)


def _again(
    kind: type[Error], message: str, code: str, help: Optional[str], place: Optional[Place]
) -> Error:
    return kind(message, code=code, help=help, place=place)
