//! Sketches in parallel projection as SVG: solids by their outlines, drawn from the back to the front.

use std::fmt::Write as _;

use nalgebra::{Point3, Rotation3, Vector3};

/// Colours of Okabe and Ito for axes x, y and z.
pub const AXES: [&str; 3] = ["#d55e00", "#009e73", "#0072b2"];
/// The first body of a joint, and links.
pub const FIRST: &str = "#c9ced6";
/// The second body of a joint.
pub const SECOND: &str = "#f2d7a6";
/// Rigid bodies.
pub const RIGID: &str = "#8fb4d9";
/// Outlines and letters.
pub const INK: &str = "#222222";
/// What moves.
pub const MOTION: &str = "#cc79a7";

/// Sides of a circle.
const SIDES: usize = 40;

/// A sketch that grows.
pub struct Sketch {
    size: [f64; 2],
    view: Rotation3<f64>,
    /// Pixels a unit of length.
    scale: f64,
    /// Where the origin lies.
    origin: [f64; 2],
    /// Each with its nearness to the eye.
    parts: Vec<(f64, String)>,
}

/// A colour, or a dash pattern, of a line.
#[derive(Clone, Copy)]
pub struct Pen<'a> {
    pub color: &'a str,
    pub width: f64,
    pub dashed: bool,
}

impl Pen<'_> {
    pub const INK: Pen<'static> = Pen {
        color: INK,
        width: 1.4,
        dashed: false,
    };
    pub const DASHED: Pen<'static> = Pen {
        color: INK,
        width: 1.2,
        dashed: true,
    };
}

impl Sketch {
    /// An empty page of this size in pixels, looked at from azimuth and elevation \[°\].
    pub fn new(size: [f64; 2], azimuth: f64, elevation: f64) -> Self {
        let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
        // Rows: to the right, up, towards the eye.
        let towards = Vector3::new(
            elevation.cos() * azimuth.cos(),
            elevation.cos() * azimuth.sin(),
            elevation.sin(),
        );
        let right = Vector3::new(-azimuth.sin(), azimuth.cos(), 0.0);
        let up = towards.cross(&right);
        let axes = nalgebra::Matrix3::from_columns(&[right, up, towards]);
        Self {
            size,
            view: Rotation3::from_matrix_unchecked(axes).inverse(),
            scale: 1.0,
            origin: [0.0; 2],
            parts: Vec::new(),
        }
    }

    /// What is drawn from here on has its origin at this place of the page, and this scale.
    pub fn at(&mut self, origin: [f64; 2], scale: f64) -> &mut Self {
        self.origin = origin;
        self.scale = scale;
        self
    }

    /// A point on the page, and its nearness to the eye.
    fn place(&self, point: &Point3<f64>) -> ([f64; 2], f64) {
        let seen = self.view * point;
        let [x, y] = self.origin;
        (
            [x + self.scale * seen.x, y - self.scale * seen.y],
            self.scale * seen.z,
        )
    }

    fn add(&mut self, near: f64, part: String) {
        self.parts.push((near, part));
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point3<f64>], pen: Pen<'_>) {
        let (path, near) = self.path(points);
        let part = stroke(&path, pen, "none");
        self.add(near, part);
    }

    /// A filled polygon with an outline.
    pub fn polygon(&mut self, points: &[Point3<f64>], fill: &str) {
        let (path, near) = self.path(points);
        let part = stroke(&(path + "Z"), Pen::INK, fill);
        self.add(near, part);
    }

    fn path(&self, points: &[Point3<f64>]) -> (String, f64) {
        let mut path = String::new();
        let mut near = 0.0;
        for (k, point) in points.iter().enumerate() {
            let ([x, y], depth) = self.place(point);
            near += depth / points.len() as f64;
            let _ = write!(path, "{}{x:.1} {y:.1}", if k == 0 { "M" } else { "L" });
        }
        (path, near)
    }

    /// A round rod from `a` to `b`.
    pub fn rod(&mut self, a: &Point3<f64>, b: &Point3<f64>, radius: f64, fill: &str) {
        let axis = (b - a).normalize();
        let ring = |center: &Point3<f64>| circle(center, &axis, radius);
        let eye = self.view.inverse() * Vector3::z();
        let (far, front) = if axis.dot(&eye) > 0.0 { (a, b) } else { (b, a) };
        let across = axis.cross(&eye);
        let (_, near) = self.path(&[*a, *b]);
        let mut part = String::new();
        let (path, _) = self.path(&ring(far));
        part += &stroke(&(path + "Z"), Pen::INK, fill);
        if across.norm() > 1e-9 {
            let side = across.normalize() * radius;
            let (path, _) = self.path(&[a + side, b + side, b - side, a - side]);
            part += &format!("<path d=\"{path}Z\" fill=\"{fill}\"/>\n");
            for side in [side, -side] {
                let (path, _) = self.path(&[a + side, b + side]);
                part += &stroke(&path, Pen::INK, "none");
            }
        }
        let (path, _) = self.path(&ring(front));
        part += &stroke(&(path + "Z"), Pen::INK, fill);
        self.add(near, part);
    }

    /// A ball.
    pub fn ball(&mut self, center: &Point3<f64>, radius: f64, fill: &str) {
        let (_, near) = self.place(center);
        self.disc(near + radius * self.scale, center, radius, fill);
    }

    /// A ball in front of all solids.
    pub fn knob(&mut self, center: &Point3<f64>, radius: f64, fill: &str) {
        self.disc(f64::MAX / 2.0, center, radius, fill);
    }

    fn disc(&mut self, near: f64, center: &Point3<f64>, radius: f64, fill: &str) {
        let ([x, y], _) = self.place(center);
        let r = radius * self.scale;
        self.add(
            near,
            format!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\" fill=\"{fill}\" stroke=\"{INK}\" \
                 stroke-width=\"1.4\"/>\n"
            ),
        );
    }

    /// A box about `center` with these half sides along the axes of `frame`.
    pub fn cuboid(
        &mut self,
        center: &Point3<f64>,
        frame: &Rotation3<f64>,
        half: [f64; 3],
        fill: &str,
    ) {
        let eye = self.view.inverse() * Vector3::z();
        let (_, near) = self.place(center);
        let mut part = String::new();
        for axis in 0..3 {
            let column = |k: usize| frame.matrix().column(k).into_owned() * half[k];
            let normal = column(axis);
            let normal = normal * normal.dot(&eye).signum();
            let (u, v) = (column((axis + 1) % 3), column((axis + 2) % 3));
            let face = [u + v, v - u, -u - v, u - v].map(|corner| center + normal + corner);
            let (path, _) = self.path(&face);
            part += &stroke(&(path + "Z"), Pen::INK, fill);
        }
        self.add(near, part);
    }

    /// An arrow, on top of everything.
    pub fn arrow(&mut self, from: &Point3<f64>, to: &Point3<f64>, color: &str) {
        let (a, _) = self.place(from);
        let (b, _) = self.place(to);
        let part = arrow(&[a, b], color);
        self.add(f64::MAX, part);
    }

    /// A turn about `axis` at `center`, on top of everything.
    pub fn turn(&mut self, center: &Point3<f64>, axis: &Vector3<f64>, radius: f64, color: &str) {
        let ring = circle(center, axis, radius);
        let points: Vec<_> = ring[..SIDES * 3 / 4]
            .iter()
            .map(|point| self.place(point).0)
            .collect();
        let part = arrow(&points, color);
        self.add(f64::MAX, part);
    }

    /// A frame: its axes as arrows with their names.
    pub fn frame(&mut self, origin: &Point3<f64>, frame: &Rotation3<f64>, length: f64) {
        for (k, (name, color)) in ["x", "y", "z"].into_iter().zip(AXES).enumerate() {
            let end = origin + frame.matrix().column(k) * length;
            self.arrow(origin, &end, color);
            let beyond = origin + frame.matrix().column(k) * (length * 1.18);
            self.letters(&beyond, [0.0, 5.0], name, color);
        }
    }

    /// Words at a point, moved by so many pixels, centred.
    pub fn letters(&mut self, point: &Point3<f64>, by: [f64; 2], words: &str, color: &str) {
        let ([x, y], _) = self.place(point);
        self.words([x + by[0], y + by[1]], words, 15.0, color);
    }

    /// Words in ink at a point, moved by so many pixels.
    pub fn words_at(&mut self, point: &Point3<f64>, by: [f64; 2], words: &str) {
        self.letters(point, by, words, INK);
    }

    /// Words on the page, centred at `x`.
    pub fn words(&mut self, [x, y]: [f64; 2], words: &str, size: f64, color: &str) {
        self.add(
            f64::MAX,
            format!(
                "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" fill=\"{color}\" \
                 text-anchor=\"middle\">{}</text>\n",
                words.replace('&', "&amp;").replace('<', "&lt;")
            ),
        );
    }

    /// A rectangle on the page with words in it, a line each.
    pub fn panel(
        &mut self,
        [x, y]: [f64; 2],
        [width, height]: [f64; 2],
        fill: &str,
        lines: &[&str],
    ) {
        self.add(
            f64::MIN,
            format!(
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"6\" \
                 fill=\"{fill}\" stroke=\"{INK}\" stroke-width=\"1.2\"/>\n"
            ),
        );
        let first = y + height / 2.0 - 9.5 * lines.len() as f64 + 14.0;
        for (k, line) in lines.iter().enumerate() {
            self.words([x + width / 2.0, first + 19.0 * k as f64], line, 14.0, INK);
        }
    }

    /// An arrow on the page.
    pub fn flow(&mut self, from: [f64; 2], to: [f64; 2]) {
        let part = arrow(&[from, to], INK);
        self.add(f64::MAX, part);
    }

    /// The ground under a point: a line with hatches, on the page.
    pub fn ground(&mut self, point: &Point3<f64>, along: [f64; 2], length: f64) {
        let ([x, y], near) = self.place(point);
        let normal = [along[1], -along[0]];
        let mut path = String::new();
        let at = |t: f64, n: f64| {
            [
                x + along[0] * t + normal[0] * n,
                y + along[1] * t + normal[1] * n,
            ]
        };
        let (a, b) = (at(-length / 2.0, 0.0), at(length / 2.0, 0.0));
        let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", a[0], a[1], b[0], b[1]);
        let count = (length / 8.0).round() as usize;
        for k in 0..count {
            let t = -length / 2.0 + 8.0 * (k as f64 + 0.5);
            let (a, b) = (at(t, 0.0), at(t - 6.0, -8.0));
            let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", a[0], a[1], b[0], b[1]);
        }
        let part = stroke(&path, Pen::INK, "none");
        self.add(near, part);
    }

    /// A spring between two points: a zigzag.
    pub fn spring(&mut self, a: &Point3<f64>, b: &Point3<f64>, width: f64) {
        let (start, near) = self.place(a);
        let (end, _) = self.place(b);
        let along = [end[0] - start[0], end[1] - start[1]];
        let length = along[0].hypot(along[1]);
        let normal = [-along[1] / length * width, along[0] / length * width];
        let mut path = String::new();
        for k in 0..=10 {
            let t = match k {
                0 => 0.0,
                10 => 1.0,
                k => 0.15 + 0.7 * (f64::from(k) - 1.0) / 8.0,
            };
            let side = match k {
                0 | 1 | 9 | 10 => 0.0,
                k if k % 2 == 0 => 1.0,
                _ => -1.0,
            };
            let [x, y] = [
                start[0] + t * along[0] + side * normal[0],
                start[1] + t * along[1] + side * normal[1],
            ];
            let _ = write!(path, "{}{x:.1} {y:.1}", if k == 0 { "M" } else { "L" });
        }
        let part = stroke(&path, Pen::INK, "none");
        self.add(near + 1.0, part);
    }

    /// The document.
    pub fn svg(mut self) -> String {
        let [width, height] = self.size;
        self.parts.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let parts: String = self.parts.into_iter().map(|(_, part)| part).collect();
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"Liberation Sans, Arimo, Arial, Helvetica, \
             sans-serif\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{parts}</svg>\n"
        )
    }
}

/// Points of a circle about an axis.
fn circle(center: &Point3<f64>, axis: &Vector3<f64>, radius: f64) -> Vec<Point3<f64>> {
    let axis = axis.normalize();
    let mut least = Vector3::zeros();
    least[axis.iamin()] = 1.0;
    let u = axis.cross(&least).normalize();
    let v = axis.cross(&u);
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / SIDES as f64;
    (0..SIDES)
        .map(|k| center + (u * angle(k).cos() + v * angle(k).sin()) * radius)
        .collect()
}

fn stroke(path: &str, pen: Pen<'_>, fill: &str) -> String {
    let dashes = if pen.dashed {
        " stroke-dasharray=\"6 4\""
    } else {
        ""
    };
    format!(
        "<path d=\"{path}\" fill=\"{fill}\" stroke=\"{}\" stroke-width=\"{}\" \
         stroke-linejoin=\"round\"{dashes}/>\n",
        pen.color, pen.width
    )
}

/// A line through points of the page that ends in a head.
fn arrow(points: &[[f64; 2]], color: &str) -> String {
    let mut path = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let _ = write!(path, "{}{x:.1} {y:.1}", if k == 0 { "M" } else { "L" });
    }
    let pen = Pen {
        color,
        width: 2.0,
        dashed: false,
    };
    let mut part = stroke(&path, pen, "none");
    if let [.., a, b] = points {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy).max(1e-9);
        let (dx, dy) = (dx / length, dy / length);
        let corner = |side: f64| {
            [
                b[0] - 9.0 * dx - side * 4.0 * dy,
                b[1] - 9.0 * dy + side * 4.0 * dx,
            ]
        };
        let [p, q] = [corner(1.0), corner(-1.0)];
        let tip = [b[0] + 2.0 * dx, b[1] + 2.0 * dy];
        let _ = writeln!(
            part,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}Z\" fill=\"{color}\"/>",
            tip[0], tip[1], p[0], p[1], q[0], q[1]
        );
    }
    part
}
