"""Mechanisms: read, asked, swept, changed."""

from __future__ import annotations

import html
import json
import math
from collections.abc import Callable, Mapping, Sequence
from operator import index
from os import PathLike, fsdecode
from pathlib import Path
from typing import Any, ClassVar, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _hyperstat
from ._data import Part, data, dumps, ron, with_names
from ._errors import ArgumentError, Error, SelectionError
from ._hyperstat import Core, Pose
from ._joints import JointKind
from ._poses import OnePose, Poses, columns_of, one_pose
from ._solution import Solution
from ._table import Table

Array = npt.NDArray[np.float64]
Along = Union[Literal["displacement", "x", "y", "z", "rx", "ry", "rz"], Sequence[float]]
Progress = Union[bool, Callable[[int, int], object]]

# As the command line has it.
_MOST_MODES = 1000


class Mechanism:
    """A mechanism in one configuration.

    Parameters
    ----------
    source : str or mapping
        A mechanism or batch file as text (RON or JSON), or the data of one: names as in a file, values
        plain or parts such as `hyperstat.Beam`. Beams may hold their section and material themselves.
    job : str, optional
        Job of a batch; may be left out where there is only one.
    design, pose : int
        Numbers, from 0, of the design and of the pose of a job.
    path : path, optional
        What messages call the text; files that it names are found beside it.
    joints : sequence of JointKind
        Kinds of joints of one's own that it names.

    Raises
    ------
    InputError
        With the place of the first mistake.
    SelectionError
        There is no such job, design or pose.
    """

    _core: Core
    # What it was made of, and what was done to it since: for pickle.
    _made: tuple[Any, ...]
    # Names and places of zeros of poses that were found to be ones.
    _posed: set[tuple[object, ...]]

    def __init__(
        self,
        source: Union[str, Mapping[str, Any]],
        *,
        job: Optional[str] = None,
        design: int = 0,
        pose: int = 0,
        path: Optional[Union[str, PathLike[str]]] = None,
        joints: Sequence[JointKind] = (),
    ) -> None:
        if not isinstance(source, (str, Mapping)):
            raise ArgumentError(
                f"`{source!r}` is no mechanism",
                help="give the text or the data of a file, or read a file by `hyperstat.load(path)`",
            )
        name = "text" if isinstance(source, str) else "data"
        text = source if isinstance(source, str) else dumps(with_names(source))
        at = name if path is None else _path(path)
        self._make("parse", text, at, _job(job), *_chosen(design, pose), _kinds(joints))

    def _make(self, by: str, *arguments: Any) -> None:
        # Kinds of joints as the core has them.
        given = ([kind._core for kind in own] if isinstance(own, _Kinds) else own for own in arguments)
        self._core = getattr(_hyperstat, by)(*given)
        self._made = (by, arguments)
        self._posed = set()

    def _changed(self, by: str, given: Any) -> Mechanism:
        """What a method of the core makes of it."""
        new = Mechanism.__new__(Mechanism)
        new._core = getattr(self._core, by)(given)
        new._made = (*self._made, (by, given))
        new._posed = set()
        return new

    def __reduce__(self) -> tuple[object, ...]:
        return _again, (type(self), self._made)

    def __copy__(self) -> Mechanism:
        # Nothing changes one.
        return self

    def __deepcopy__(self, memo: object) -> Mechanism:
        return self

    # What it is.

    @property
    def name(self) -> str:
        """Its name."""
        return self._core.called()[0]

    @property
    def job(self) -> Optional[str]:
        """The job that it is from."""
        return self._core.called()[1]

    @property
    def designs(self) -> int:
        """Number of designs of its job."""
        return self._core.counts()[0]

    @property
    def poses(self) -> int:
        """Number of poses of its own: those of its job, else 1, its configuration."""
        return self._core.counts()[1]

    @property
    def cases(self) -> list[str]:
        """Names of its load cases."""
        return self._core.counts()[2]

    @property
    def path(self) -> Path:
        """The file that it is from."""
        return self._core.path()

    # What it is asked.

    def solve(
        self,
        *,
        verify: bool = False,
        all_nodes: bool = False,
        modes: Optional[int] = None,
        mass: Optional[Literal["Exact", "Consistent", "Lumped"]] = None,
        why: bool = False,
        case: Optional[str] = None,
        along: Along = "displacement",
        allow_free: bool = False,
    ) -> Solution:
        """Solves it, in its configuration, under its loads and in every load case.

        Parameters
        ----------
        verify : bool
            Solve a second time with the independent solver, and tell the largest differences.
        all_nodes : bool
            Displacements of the nodes inside segments too.
        modes : int, optional
            So many natural frequencies, the lowest.
        mass : {"Exact", "Consistent", "Lumped"}, optional
            Masses of beams in modes.
        why : bool
            What is soft and why: budget, sensitivities, measures.
        case : str, optional
            The case that `why` is of.
        along : str or (3,) array_like
            The direction of the budget.
        allow_free : bool
            An output that moves freely is then no error: `stiffness` tells what there is.

        Returns
        -------
        Solution

        Raises
        ------
        UnsolvableError
            It has no solution, with the part that is to blame; its output moves freely.
        PoseError
            The pose of its job is out of reach.
        SelectionError
            There is no such case.
        """
        if modes is not None and not 1 <= _whole(modes, "natural frequencies") <= _MOST_MODES:
            raise ArgumentError(f"{modes} natural frequencies", help=f"ask for 1 to {_MOST_MODES}")
        word = along if isinstance(along, str) else None
        direction = None if isinstance(along, str) else _direction(along)
        text = self._core.solve(
            verify, all_nodes, modes, mass, why, case, word, direction, allow_free
        )
        return Solution(text, self)

    def check(self) -> dict[str, Any]:
        """Its counts, what may be a slip, and whether it can be solved.

        Returns
        -------
        dict
            The JSON of `hyperstat check`.
        """
        report: dict[str, Any] = json.loads(self._core.check())
        return report

    def at(self, pose: OnePose) -> Pose:
        """One pose, as a row of a sweep, in microseconds: what is worked out once is kept.

        Parameters
        ----------
        pose : (3,) or (6,) array_like, or mapping
            x, y, z [m] and rotation vector rx, ry, rz [rad] of the output from home, global; or
            coordinates or drives `joint.direction` [m, rad] by name.

        Returns
        -------
        Pose
            With `status`, `stiffness` (6, 6), `displacement` (6,); NaN without a result.
        """
        return self._core.at(self._one(pose))

    def _one(self, pose: OnePose) -> Union[list[float], dict[str, float]]:
        """A pose that `sweep` takes too: what a pose must be does not depend on those before it."""
        names, numbers = one_pose(pose)
        given = numbers if names is None else dict(zip(names, numbers))
        # What is right with a pose depends on its names and on what is zero of it alone.
        like = (names, len(numbers), *(number == 0.0 for number in numbers))
        if like not in self._posed or not all(map(math.isfinite, numbers)):
            self._core.in_pose(given)
            self._posed.add(like)
        return given

    def sweep(
        self,
        poses: Optional[Poses] = None,
        loads: Optional[Sequence[Any]] = None,
        *,
        cases: Optional[Mapping[str, Sequence[Any]]] = None,
        columns: Optional[Sequence[Any]] = None,
        modes: Optional[int] = None,
        threads: int = 0,
        one_by_one: bool = False,
        progress: Progress = False,
    ) -> Table:
        """Solves it in many poses, on all cores.

        Parameters
        ----------
        poses : (n, 3) or (n, 6) array_like, or mapping of (n,) array_like
            x, y, z [m] and rotation vector rx, ry, rz [rad] of the output from home, global; or columns
            by name: coordinates, or drives `joint.direction` [m, rad]. Left out: the poses of its job.
        loads : sequence of Load or dict, optional
            In place of its own.
        cases : mapping, optional
            Load cases by name, in place of its own.
        columns : sequence, optional
            More columns, as a job's `columns`: `"Drives"`, `"Stress"`, `"Mass"`, `"Measures"`, ...
        modes : int, optional
            So many natural frequencies at every pose, `f1`, `f2`, ...
        threads : int
            0 is one a core. The numbers are the same with any.
        one_by_one : bool
            Not eight at once: to compare with.
        progress : bool or callable
            True: a bar, where tqdm is installed. A callable gets the rows that are done, and all; what it
            raises ends the sweep, as Ctrl-C does.

        Returns
        -------
        Table
            A row a pose. A pose without a result is a row of NaN with a word in `status`, no error.

        Raises
        ------
        InputError, ArgumentError
            Poses or loads that mean nothing, with their place.
        UnsolvableError
            It has no solution in any pose.
        """
        fields = {"loads": loads, "cases": cases, "columns": columns, "modes": modes}
        return self._swept(poses, fields, None, threads, one_by_one, progress)

    def evaluate(
        self,
        designs: Mapping[str, Union[Sequence[Union[float, str, Part]], npt.NDArray[np.float64]]],
        poses: Optional[Poses] = None,
        *,
        columns: Optional[Sequence[Any]] = None,
        threads: int = 0,
        progress: Progress = False,
    ) -> Table:
        """Solves many designs in many poses in one call.

        Parameters
        ----------
        designs : mapping of (d,) sequences
            Values by path, side by side: design k has the k-th of each.
        poses, columns, threads, progress
            As of `sweep`.

        Returns
        -------
        Table
            Design by design, a row a pose; `table.by_design(array)` has the shape (d, n, ...).
        """
        if not isinstance(designs, Mapping):
            raise ArgumentError(f"`{designs!r}` are no designs", help="give a mapping of paths to values")
        varied = [(str(path), _values(path, values)) for path, values in designs.items()]
        return self._swept(poses, {"columns": columns}, varied, threads, False, progress)

    def _swept(
        self,
        poses: Optional[Poses],
        fields: Mapping[str, Any],
        designs: Optional[list[tuple[str, list[Union[float, str]]]]],
        threads: int,
        one_by_one: bool,
        progress: Progress,
        rows: Optional[tuple[int, int]] = None,
    ) -> Table:
        table = None if poses is None else columns_of(poses)
        threads = threads_of(threads)
        call, close = _reporter(progress)
        try:
            found = self._core.sweep(table, _json(fields), designs, rows, threads, one_by_one, call)
        finally:
            close()
        return Table(found)

    def value_and_gradient(
        self,
        measure: str,
        paths: Sequence[str],
        poses: Optional[Poses] = None,
        *,
        case: Optional[str] = None,
        threads: int = 0,
    ) -> tuple[Array, Array]:
        """A measure and its derivatives by values of the mechanism.

        Parameters
        ----------
        measure : str
            Of `hyperstat.measures()`, or `k11` to `k66`, `dx` to `drz`.
        paths : sequence of str
            Of any numbers, as `vary` names them: exact derivatives by those that `solve(why=True)` lists
            (dimensions of sections, constants of materials, masses, joint stiffnesses, parameters),
            differences of designs by others (lengths, coordinates of points, axes, loads), in the same
            pose of the output.
        poses
            As of `sweep`.
        case : str, optional
            The case whose displacement it is of.

        Returns
        -------
        v : (n,) ndarray
            SI; NaN where a pose has no result.
        g : (n, len(paths)) ndarray
            By each value, SI.

        Raises
        ------
        ArgumentError
            A measure that there is not; a path that leads to no number.
        """
        table = None if poses is None else columns_of(poses)
        if isinstance(paths, str):
            raise ArgumentError(f"`{paths}` is one path", help=f'give a list of paths, `["{paths}"]`')
        each = list(paths)
        for what, word in (("measure", measure), *(("path", path) for path in each)):
            if not isinstance(word, str):
                raise ArgumentError(f"`{word!r}` is no {what}", help="give a text")
        return self._core.value_and_gradient(measure, each, table, case, threads_of(threads))

    # What it becomes.

    def with_values(self, values: Mapping[str, Union[float, str, Part]]) -> Mechanism:
        """The same with other values in some places.

        Parameters
        ----------
        values : mapping
            Numbers (SI), texts as they stand in a file, or parts such as `Circle`, by path: `sections.rod.diameter`,
            `rod.section.diameter` of a prebuilt mechanism, the name of a parameter.

        Raises
        ------
        InputError
            A path that leads nowhere, or what is wrong with the mechanism that the values make.
        """
        if not isinstance(values, Mapping):
            raise ArgumentError(f"`{values!r}` are no values", help="give a mapping of paths to values")
        given = [(str(path), _value(value)) for path, value in values.items()]
        return self._changed("with_values", given)

    def with_loads(
        self,
        loads: Optional[Sequence[Any]] = None,
        *,
        cases: Optional[Mapping[str, Sequence[Any]]] = None,
        **fields: Any,
    ) -> Mechanism:
        """The same under other loads, or with another output.

        Parameters
        ----------
        loads : sequence of Load or dict, optional
        cases : mapping, optional
            Load cases by name.
        **fields
            Other fields of a job: `gravity`, `masses`, `misfits`, `preloads`, `output`, `tool`, `modes`,
            `columns`.

        Raises
        ------
        InputError
            What means nothing, with its place in the argument.
        """
        all_fields = {"loads": loads, "cases": cases, **fields}
        return self._changed("with_fields", _json(all_fields))

    def in_pose(self, pose: OnePose) -> Mechanism:
        """The same in another pose.

        Parameters
        ----------
        pose
            As of `at`.
        """
        names, numbers = one_pose(pose)
        return self._changed("in_pose", numbers if names is None else dict(zip(names, numbers)))

    def to_ron(self) -> str:
        """It in its configuration as a mechanism file (RON)."""
        return self._core.written(False)

    def to_json(self) -> str:
        """It in its configuration as a mechanism file (JSON)."""
        return self._core.written(True)

    def __repr__(self) -> str:
        name, job, design, pose = self._core.called()
        parts = [f"{name!r}"]
        parts += [f"job={job!r}"] if job not in (None, name) else []
        parts += [] if design is None else [f"design={design}"]
        parts += [f"pose={pose}"] if job is not None and self.poses > 1 else []
        return f"<hyperstat.{type(self).__name__} {' '.join(parts)}>"

    def _repr_html_(self) -> str:
        try:
            report = self.check()
        except Error as error:
            title = html.escape(repr(self)[1:-1])
            return f"<b>{title}</b><p>{html.escape(error.message)}</p>"
        rows = [
            ("mobility", report.get("mobility")),
            ("over-constraint", report.get("overconstraint")),
            ("unknowns", report.get("unknowns")),
            ("cases", ", ".join(self.cases) or None),
        ]
        problem = report.get("problem")
        rows += [("problem", problem["message"])] if problem else []
        cells = "".join(
            f"<tr><th>{name}</th><td>{html.escape(str(value))}</td></tr>"
            for name, value in rows
            if value is not None
        )
        return f"<b>{html.escape(repr(self)[1:-1])}</b><table>{cells}</table>"


class Prebuilt(Mechanism):
    """A prebuilt mechanism by its parameters, under no loads and in no pose yet: `in_pose`, `at` and `sweep`
    bring it to some, `with_loads` loads it.
    """

    _kind: ClassVar[Optional[str]] = None
    _words: ClassVar[Mapping[str, str]] = {}

    def _set(self, **fields: Any) -> None:
        given = {self._words.get(name, name): data(own) for name, own in fields.items() if own is not None}
        kind = self._kind or ""
        self._data = {kind: given}
        self._make("prebuilt", dumps(self._data), kind)

    def to_data(self) -> dict[str, Any]:
        """What stands in a JSON file as the mechanism of a job.

        Returns
        -------
        dict
        """
        return dict(json.loads(json.dumps(self._data)))

    def _repr_html_(self) -> str:
        return html.escape(repr(self))


def load(
    path: Union[str, PathLike[str]],
    job: Optional[str] = None,
    design: int = 0,
    *,
    pose: int = 0,
    joints: Sequence[JointKind] = (),
) -> Mechanism:
    """Reads a mechanism file, or one job of a batch file (RON or JSON).

    Parameters
    ----------
    path : path
    job : str, optional
        Job of a batch; may be left out where there is only one.
    design, pose : int
        Numbers, from 0, of the design and of the pose of a job.
    joints : sequence of JointKind
        Kinds of joints of one's own that the file names.

    Returns
    -------
    Mechanism

    Raises
    ------
    InputError
        With the place of the first mistake.
    SelectionError
        There is no such job, design or pose.
    """
    at = _path(path)
    new = Mechanism.__new__(Mechanism)
    chosen = (_job(job), *_chosen(design, pose), _kinds(joints))
    new._make("load", at, *chosen)
    try:
        # A pickle has the text: the file may change or be elsewhere.
        new._made = ("parse", (Path(at).read_bytes().decode("utf-8"), at, *chosen))
    except (OSError, UnicodeDecodeError):
        pass
    return new


def schema() -> str:
    """The JSON Schema of files, as `hyperstat schema` prints it."""
    return _hyperstat.schema()


def measures() -> dict[str, tuple[str, str]]:
    """Unit and meaning of every measure that `Table.measure` and `Pose.measure` take, by its name."""
    return {name: (unit, words) for name, unit, words in _hyperstat.measures()}


def _chosen(design: int, pose: int) -> tuple[Optional[int], Optional[int]]:
    """What is chosen of a batch; nothing for the first, which a mechanism file has too."""
    for what, number in (("design", design), ("pose", pose)):
        if _whole(number, f"as the number of a {what}") < 0:
            raise SelectionError(
                f"there is no {what} {number}", code=f"unknown-{what}", help="they are counted from 0"
            )
    return design or None, pose or None


def _value(value: Any) -> Union[float, str]:
    if isinstance(value, str):
        return value
    if isinstance(value, Part):
        return ron(value)
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ArgumentError(
            f"`{value!r}` is no value", help="give a number or a text"
        ) from None


def _values(path: object, values: Any) -> list[Union[float, str]]:
    """Values of designs."""
    if isinstance(values, (str, Part, Mapping)) or not hasattr(values, "__iter__") or np.ndim(values) == 0:
        raise ArgumentError(
            f"`{values!r}` are no values for `{path}`", help="give a sequence, one for each design"
        )
    return [_value(own) for own in values]


def _whole(number: Any, what: str) -> int:
    try:
        return index(number)
    except TypeError:
        raise ArgumentError(f"`{number!r}` {what}", help="give a whole number") from None


def threads_of(threads: Any) -> int:
    if _whole(threads, "threads") < 0:
        raise ArgumentError(f"{threads} threads", help="0 is one a core")
    return index(threads)


def _direction(along: Any) -> list[float]:
    try:
        direction = [float(number) for number in along]
    except (TypeError, ValueError):
        direction = []
    if len(direction) != 3:
        raise ArgumentError(
            f"`{along!r}` is no direction", help="give three numbers, or a word such as `displacement`"
        )
    return direction


class _Kinds(tuple[JointKind, ...]):
    """Kinds of joints that a mechanism is read with."""


def _kinds(joints: Any) -> _Kinds:
    kinds = _Kinds(joints) if hasattr(joints, "__iter__") else _Kinds((joints,))
    for kind in kinds:
        if not isinstance(kind, JointKind):
            raise ArgumentError(
                f"`{kind!r}` is no kind of joint", help="give a list of `hyperstat.JointKind`"
            )
    return kinds


def _path(path: Any) -> str:
    try:
        return fsdecode(path)
    except TypeError:
        raise ArgumentError(f"`{path!r}` is no path", help="give a text or a `pathlib.Path`") from None


def _job(job: Any) -> Optional[str]:
    if job is not None and not isinstance(job, str):
        raise ArgumentError(f"`{job!r}` is no job", help="give its name")
    return job


def _again(kind: type[Mechanism], made: tuple[Any, ...]) -> Mechanism:
    """One that was pickled."""
    by, arguments, *changes = made
    new = kind.__new__(kind)
    new._make(by, *arguments)
    if isinstance(new, Prebuilt):
        new._data = json.loads(arguments[0])
    for change, given in changes:
        new = new._changed(change, given)
    return new


def _json(fields: Mapping[str, Any]) -> list[tuple[str, str]]:
    return [(name, dumps(data(own))) for name, own in fields.items() if own is not None]


def _reporter(
    progress: Progress,
) -> tuple[Optional[Callable[[int, int], object]], Callable[[], object]]:
    """What is called with the rows that are done, and what ends it."""
    if callable(progress):
        return progress, lambda: None
    if not progress:
        return None, lambda: None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None, lambda: None
    bar = tqdm(unit=" poses")

    def show(done: int, total: int) -> None:
        bar.total = total
        bar.update(done - bar.n)

    return show, bar.close
