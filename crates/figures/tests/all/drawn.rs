//! What an SVG shows, in tenths of a pixel.

use resvg::usvg::roxmltree::{Document, Node};

/// The points of a line or a polygon.
pub fn points(node: Node<'_, '_>) -> Vec<[f64; 2]> {
    let list = node.attribute("points").unwrap();
    let numbers: Vec<f64> = list
        .split([' ', ','])
        .filter(|number| !number.is_empty())
        .map(|number| number.parse().unwrap())
        .collect();
    numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// All text with its place.
pub fn texts(document: &Document<'_>) -> Vec<(String, [f64; 2])> {
    let texts = document.descendants().filter(|n| n.has_tag_name("text"));
    let at = |node: &Node<'_, '_>, name: &str| node.attribute(name).unwrap().parse().unwrap();
    texts
        .map(|node| {
            let text = node.text().unwrap_or_default().trim().to_string();
            (text, [at(&node, "x"), at(&node, "y")])
        })
        .collect()
}
