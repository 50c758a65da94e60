//! Pages to look at.

use hyperstat_study::View;
use pyo3::prelude::*;

use crate::mechanism::Core;
use crate::watched::watched;

/// Whether pages have the core in them.
pub(crate) const LIVE: bool = View::LIVE;

/// A mechanism in its configuration as a page, one HTML document.
#[pyfunction]
pub(crate) fn view(core: &Bound<'_, Core>, title: String) -> PyResult<String> {
    let own = core.clone().unbind();
    watched(core.py(), None, move |_| {
        let own = own.get();
        let text = own.asked(|study| Ok(study.mechanism_file(&own.registry)?))?;
        let view = View::of_text(title, "mechanism.ron", text);
        Ok(view.html(&own.registry)?)
    })
}
