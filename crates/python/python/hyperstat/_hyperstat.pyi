"""The core. What users need is in `hyperstat`."""

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Optional, Union, final

import numpy as np
import numpy.typing as npt

_Array = npt.NDArray[np.float64]
_Pose = Union[_Array, Sequence[float], dict[str, float]]
_Value = Union[float, str]

__all__ = [
    "Core",
    "Found",
    "JointKind",
    "Pose",
    "__version__",
    "after_fork",
    "before_fork",
    "begin_run",
    "column",
    "lasts",
    "live",
    "load",
    "measure",
    "measures",
    "merge_run",
    "parse",
    "pose_again",
    "prebuilt",
    "run_share",
    "schema",
    "view",
]

__version__: str
live: bool

@final
class Core:
    def solve(
        self,
        verify: bool,
        all_nodes: bool,
        modes: Optional[int],
        mass: Optional[str],
        why: bool,
        case: Optional[str],
        along: Optional[str],
        direction: Optional[Sequence[float]],
        allow_free: bool,
    ) -> str: ...
    def check(self) -> str: ...
    def vtu(self) -> str: ...
    def written(self, as_json: bool) -> str: ...
    def with_values(self, values: Sequence[tuple[str, _Value]]) -> Core: ...
    def with_fields(self, fields: Sequence[tuple[str, str]]) -> Core: ...
    def in_pose(self, pose: _Pose) -> Core: ...
    def at(self, pose: _Pose) -> Pose: ...
    def sweep(
        self,
        poses: Optional[tuple[Sequence[str], _Array]],
        fields: Sequence[tuple[str, str]],
        designs: Optional[Sequence[tuple[str, Sequence[_Value]]]],
        rows: Optional[tuple[int, int]],
        threads: int,
        one_by_one: bool,
        progress: Optional[Callable[[int, int], object]],
    ) -> Found: ...
    def value_and_gradient(
        self,
        quantity: str,
        paths: Sequence[str],
        poses: Optional[tuple[Sequence[str], _Array]],
        case: Optional[str],
        threads: int,
    ) -> tuple[_Array, _Array]: ...
    def numbers(self, paths: Sequence[str]) -> list[float]: ...
    def called(self) -> tuple[str, Optional[str], Optional[int], Optional[int]]: ...
    def counts(self) -> tuple[int, int, list[str]]: ...
    def path(self) -> Path: ...

@final
class Found:
    @property
    def pose(self) -> _Array: ...
    @property
    def displacement(self) -> _Array: ...
    @property
    def stiffness(self) -> _Array: ...
    @property
    def codes(self) -> npt.NDArray[np.uint8]: ...
    @property
    def words(self) -> list[tuple[str, Optional[str]]]: ...
    @property
    def cases(self) -> list[str]: ...
    @property
    def further(self) -> list[tuple[str, Any]]: ...
    @property
    def drives(self) -> tuple[list[str], _Array]: ...
    @property
    def designs(self) -> int: ...
    @property
    def varied(self) -> tuple[int, list[tuple[str, list[_Value]]]]: ...

@final
class JointKind:
    def __new__(
        cls,
        name: str,
        free: Sequence[str],
        frame: str,
        arguments: Sequence[str],
        make: Callable[[list[float]], tuple[Optional[list[float]], Optional[list[float]]]],
    ) -> JointKind: ...

@final
class Pose:
    @property
    def status(self) -> str: ...
    @property
    def why(self) -> Optional[str]: ...
    @property
    def pose(self) -> _Array: ...
    @property
    def displacement(self) -> _Array: ...
    @property
    def stiffness(self) -> _Array: ...
    @property
    def cases(self) -> dict[str, _Array]: ...
    def __getitem__(self, name: str, /) -> Union[float, str]: ...
    def keys(self) -> list[str]: ...
    def measure(self, name: str) -> float: ...

def load(
    path: Union[str, PathLike[str]],
    job: Optional[str],
    design: Optional[int],
    pose: Optional[int],
    joints: Sequence[JointKind],
) -> Core: ...
def parse(
    text: str,
    path: Union[str, PathLike[str]],
    job: Optional[str],
    design: Optional[int],
    pose: Optional[int],
    joints: Sequence[JointKind],
) -> Core: ...
def prebuilt(text: str, name: str) -> Core: ...
def pose_again(made: tuple[Any, ...]) -> Pose: ...
def before_fork() -> None: ...
def after_fork() -> None: ...
def measure(name: str, stiffness: _Array, displacement: _Array) -> _Array: ...
def measures() -> list[tuple[str, str, str]]: ...
def column(name: str) -> tuple[str, str]: ...
def begin_run(
    batch: Union[str, PathLike[str]],
    out: Union[str, PathLike[str]],
    parquet: bool,
    summary: bool,
    pdf: bool,
    one_by_one: bool,
) -> tuple[str, int, float]: ...
def run_share(out: Union[str, PathLike[str]], run: str, index: int, count: int) -> list[str]: ...
def merge_run(
    out: Union[str, PathLike[str]], run: str
) -> list[tuple[str, int, list[tuple[str, int]], list[Path], list[str]]]: ...
def lasts(
    mechanism: Core,
    poses: tuple[Sequence[str], _Array],
    fields: Sequence[tuple[str, str]],
    one_by_one: bool,
) -> float: ...
def schema() -> str: ...
def view(core: Core, title: str) -> str: ...
