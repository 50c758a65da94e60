"""Pages to look at: a mechanism in space, to drag and ask in a browser or in a notebook."""

from __future__ import annotations

import html
from os import PathLike
from pathlib import Path
from typing import Optional, Union

from . import _hyperstat
from ._mechanism import Mechanism

__all__ = ["View", "view"]


class View:
    """A page, one HTML document that opens anywhere and fetches nothing: see `view`.

    In a notebook it is shown below its cell.
    """

    #: Whether the page answers while one drags. Else it holds what was worked out beforehand, and says so.
    live: bool = _hyperstat.live

    def __init__(self, title: str, page: str) -> None:
        self.title = title
        #: The document.
        self.html = page
        #: Height in a notebook, in pixels.
        self.height = 640

    def save(self, path: Union[str, PathLike[str]]) -> Path:
        """Writes the document; returns its path."""
        path = Path(path)
        path.write_text(self.html, encoding="utf-8")
        return path

    def _repr_html_(self) -> str:
        page = html.escape(self.html, quote=True)
        frame = f"width: 100%; height: {self.height}px; border: 0"
        title = html.escape(self.title, quote=True)
        return f'<iframe style="{frame}" title="{title}" srcdoc="{page}"></iframe>'

    def __repr__(self) -> str:
        kind = "" if self.live else ", worked out beforehand"
        return f"<hyperstat.View {self.title!r}{kind}>"


def view(mechanism: Mechanism, title: Optional[str] = None) -> View:
    """A page to look at: the mechanism in its configuration, with its loads and cases, as a file written out.

    Where the package was built with the live core (`hyperstat.View.live`), the page answers while one drags the
    output, moves drives or changes the text; else it holds answers that are worked out now.

    Parameters
    ----------
    mechanism : Mechanism
    title : str, optional
        Title of the page; else the name of the mechanism.

    Raises
    ------
    Error
        It has no file that states it, as with joints of one's own, or nothing holds it.

    Examples
    --------
    >>> import hyperstat as hs
    >>> page = hs.view(hs.load("examples/portal.ron"))
    >>> page.title
    'portal'
    """
    title = mechanism.name if title is None else title
    return View(title, _hyperstat.view(mechanism._core, title))
