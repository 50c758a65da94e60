"""Pages to look at."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hyperstat as hs


def data(page: hs.View) -> Any:
    """What stands in a page."""
    found = re.search(r'id="hyperstat-data">(.*?)</script>', page.html, re.DOTALL)
    assert found
    return json.loads(found[1])


def test_a_page_holds_the_mechanism(examples: Path, tmp_path: Path) -> None:
    m = hs.load(examples / "portal.ron")
    page = hs.view(m)
    assert page.title == "portal"
    own = data(page)
    assert hs.Mechanism(own["load"]["files"]["mechanism.ron"]).solve().stiffness == pytest.approx(m.solve().stiffness)
    path = page.save(tmp_path / "portal.html")
    assert path.read_text(encoding="utf-8") == page.html
    assert f'srcdoc="{page.html[:9].replace("<", "&lt;")}' in page._repr_html_()
    if page.live:
        assert own["answers"] == []
    else:
        solved = next(each for each in own["answers"] if each["request"] == {"ask": "solve"})
        k = np.array(solved["value"]["output"]["stiffness"])
        assert k == pytest.approx(m.solve().stiffness, rel=1e-12)


def test_a_page_is_of_the_pose_and_of_the_values(examples: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    moved = m.in_pose((0.05, 0.0, 0.52)).with_values({"rod.section.diameter": 0.02})
    text = data(hs.view(moved, "thick rods"))["load"]["files"]["mechanism.ron"]
    own = hs.Mechanism(text).solve()
    assert own.stiffness == pytest.approx(moved.solve().stiffness, rel=1e-9)


def test_what_is_not_held_is_drawn(examples: Path) -> None:
    free = (examples / "portal.ron").read_text(encoding="utf-8").replace(", locked: true", "")
    # It is drawn all the same, and the page says what is wrong.
    assert hs.view(hs.Mechanism(free)).title == "portal"
