//! Sketches in parallel projection: solids by their outlines, drawn from the back to the front with what the
//! figures are drawn with.

use std::f64::consts::FRAC_PI_2;

use hyperstat_figures::{self as figures, Pen, Rgb};
use nalgebra::{Point3, Rotation3, Vector3};

/// Colours of Okabe and Ito for axes x, y and z.
pub const AXES: [Rgb; 3] = [rgb(0xd55e00), rgb(0x009e73), rgb(0x0072b2)];
/// The first body of a joint, and links.
pub const FIRST: Rgb = rgb(0xc9ced6);
/// The second body of a joint.
pub const SECOND: Rgb = rgb(0xf2d7a6);
/// Rigid bodies.
pub const RIGID: Rgb = rgb(0x8fb4d9);
/// What is hollow.
pub const WHITE: Rgb = rgb(0xffffff);
/// Outlines and letters.
pub const INK: Rgb = rgb(0x222222);
/// What moves.
pub const MOTION: Rgb = rgb(0xcc79a7);

/// Outlines.
pub const OUTLINE: Pen = Pen {
    color: INK,
    width: 1.4,
    dashed: false,
};
/// What is not there, or behind.
pub const DASHED: Pen = Pen {
    color: INK,
    width: 1.2,
    dashed: true,
};

/// A colour by its number.
pub const fn rgb(number: u32) -> Rgb {
    let [_, red, green, blue] = number.to_be_bytes();
    [red, green, blue]
}

/// Sides of a circle.
const SIDES: usize = 40;
/// How far below the middle of letters they stand, over their size.
const BASELINE: f64 = 0.26;
/// Radius of the corners of a panel \[pixels\].
const ROUND: f64 = 6.0;

/// A sketch that grows.
pub struct Sketch {
    title: &'static str,
    size: [f64; 2],
    view: Rotation3<f64>,
    /// Pixels a unit of length.
    scale: f64,
    /// Where the origin lies.
    origin: [f64; 2],
    /// Each with its nearness to the eye.
    parts: Vec<(f64, Vec<Shape>)>,
}

/// What stands on the page.
enum Shape {
    Line(Vec<[f64; 2]>, Pen),
    Area(Vec<[f64; 2]>, Rgb),
    Disc([f64; 2], f64, Rgb),
    Words(String, [f64; 2], f64, Rgb),
}

impl Sketch {
    /// An empty page with this title and size in pixels, looked at from azimuth and elevation \[°\].
    pub fn new(title: &'static str, size: [f64; 2], azimuth: f64, elevation: f64) -> Self {
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
            title,
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

    fn add(&mut self, near: f64, part: Vec<Shape>) {
        self.parts.push((near, part));
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point3<f64>], pen: Pen) {
        let (path, near) = self.path(points);
        self.add(near, vec![Shape::Line(path, pen)]);
    }

    /// A filled polygon with an outline.
    pub fn polygon(&mut self, points: &[Point3<f64>], fill: Rgb) {
        let (path, near) = self.path(points);
        self.add(near, outlined(path, fill));
    }

    fn path(&self, points: &[Point3<f64>]) -> (Vec<[f64; 2]>, f64) {
        let places: Vec<_> = points.iter().map(|point| self.place(point)).collect();
        let depths = places.iter().map(|(_, depth)| depth / points.len() as f64);
        let near = depths.sum();
        (places.into_iter().map(|(at, _)| at).collect(), near)
    }

    /// A round rod from `a` to `b`.
    pub fn rod(&mut self, a: &Point3<f64>, b: &Point3<f64>, radius: f64, fill: Rgb) {
        let axis = (b - a).normalize();
        let ring = |center: &Point3<f64>| circle(center, &axis, radius);
        let eye = self.view.inverse() * Vector3::z();
        let (far, front) = if axis.dot(&eye) > 0.0 { (a, b) } else { (b, a) };
        let across = axis.cross(&eye);
        let (_, near) = self.path(&[*a, *b]);
        let (path, _) = self.path(&ring(far));
        let mut part = outlined(path, fill);
        if across.norm() > 1e-9 {
            let side = across.normalize() * radius;
            let (path, _) = self.path(&[a + side, b + side, b - side, a - side]);
            part.push(Shape::Area(path, fill));
            for side in [side, -side] {
                let (path, _) = self.path(&[a + side, b + side]);
                part.push(Shape::Line(path, OUTLINE));
            }
        }
        let (path, _) = self.path(&ring(front));
        part.extend(outlined(path, fill));
        self.add(near, part);
    }

    /// A ball.
    pub fn ball(&mut self, center: &Point3<f64>, radius: f64, fill: Rgb) {
        let (_, near) = self.place(center);
        self.disc(near + radius * self.scale, center, radius, fill);
    }

    /// A ball in front of all solids.
    pub fn knob(&mut self, center: &Point3<f64>, radius: f64, fill: Rgb) {
        self.disc(f64::MAX / 2.0, center, radius, fill);
    }

    fn disc(&mut self, near: f64, center: &Point3<f64>, radius: f64, fill: Rgb) {
        let (at, _) = self.place(center);
        self.add(near, vec![Shape::Disc(at, radius * self.scale, fill)]);
    }

    /// A box about `center` with these half sides along the axes of `frame`.
    pub fn cuboid(
        &mut self,
        center: &Point3<f64>,
        frame: &Rotation3<f64>,
        half: [f64; 3],
        fill: Rgb,
    ) {
        let eye = self.view.inverse() * Vector3::z();
        let (_, near) = self.place(center);
        let mut part = Vec::new();
        for axis in 0..3 {
            let column = |k: usize| frame.matrix().column(k).into_owned() * half[k];
            let normal = column(axis);
            let normal = normal * normal.dot(&eye).signum();
            let (u, v) = (column((axis + 1) % 3), column((axis + 2) % 3));
            let face = [u + v, v - u, -u - v, u - v].map(|corner| center + normal + corner);
            let (path, _) = self.path(&face);
            part.extend(outlined(path, fill));
        }
        self.add(near, part);
    }

    /// An arrow, on top of everything.
    pub fn arrow(&mut self, from: &Point3<f64>, to: &Point3<f64>, color: Rgb) {
        let (a, _) = self.place(from);
        let (b, _) = self.place(to);
        let part = arrow(&[a, b], color);
        self.add(f64::MAX, part);
    }

    /// A turn about `axis` at `center`, on top of everything.
    pub fn turn(&mut self, center: &Point3<f64>, axis: &Vector3<f64>, radius: f64, color: Rgb) {
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
    pub fn letters(&mut self, point: &Point3<f64>, by: [f64; 2], words: &str, color: Rgb) {
        let ([x, y], _) = self.place(point);
        self.words([x + by[0], y + by[1]], words, 15.0, color);
    }

    /// Words in ink at a point, moved by so many pixels.
    pub fn words_at(&mut self, point: &Point3<f64>, by: [f64; 2], words: &str) {
        self.letters(point, by, words, INK);
    }

    /// Words on the page, centred at `x`.
    pub fn words(&mut self, [x, y]: [f64; 2], words: &str, size: f64, color: Rgb) {
        // Letters stand on their places; those of figures are centred in height.
        let middle = [x, y - BASELINE * size];
        self.add(
            f64::MAX,
            vec![Shape::Words(words.into(), middle, size, color)],
        );
    }

    /// A rectangle on the page with words in it, a line each.
    pub fn panel(
        &mut self,
        [x, y]: [f64; 2],
        [width, height]: [f64; 2],
        fill: Rgb,
        lines: &[&str],
    ) {
        let corners = [
            [x + width - ROUND, y + ROUND],
            [x + ROUND, y + ROUND],
            [x + ROUND, y + height - ROUND],
            [x + width - ROUND, y + height - ROUND],
        ];
        let quarter = |(k, [x, y]): (usize, [f64; 2])| {
            (0..=6).map(move |step| {
                let angle = FRAC_PI_2 * (k as f64 + f64::from(step) / 6.0);
                [x + ROUND * angle.cos(), y - ROUND * angle.sin()]
            })
        };
        let path = corners.into_iter().enumerate().flat_map(quarter).collect();
        self.add(f64::MIN, outlined(path, fill));
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
        let at = |t: f64, n: f64| {
            [
                x + along[0] * t + normal[0] * n,
                y + along[1] * t + normal[1] * n,
            ]
        };
        let line = |a, b| Shape::Line(vec![a, b], OUTLINE);
        let mut part = vec![line(at(-length / 2.0, 0.0), at(length / 2.0, 0.0))];
        let count = (length / 8.0).round() as usize;
        part.extend((0..count).map(|k| {
            let t = -length / 2.0 + 8.0 * (k as f64 + 0.5);
            line(at(t, 0.0), at(t - 6.0, -8.0))
        }));
        self.add(near, part);
    }

    /// A spring between two points: a zigzag.
    pub fn spring(&mut self, a: &Point3<f64>, b: &Point3<f64>, width: f64) {
        let (start, near) = self.place(a);
        let (end, _) = self.place(b);
        let along = [end[0] - start[0], end[1] - start[1]];
        let length = along[0].hypot(along[1]);
        let normal = [-along[1] / length * width, along[0] / length * width];
        let bend = |k: i32| {
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
            [0, 1].map(|c| start[c] + t * along[c] + side * normal[c])
        };
        let path = (0..=10).map(bend).collect();
        self.add(near + 1.0, vec![Shape::Line(path, OUTLINE)]);
    }

    /// The document.
    pub fn svg(mut self) -> String {
        self.parts.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let size = self.size.map(|side| side.round() as u32);
        figures::Sketch::svg(size, self.title, |page| {
            for shape in self.parts.into_iter().flat_map(|(_, part)| part) {
                match shape {
                    Shape::Line(points, pen) => page.line(&points, pen),
                    Shape::Area(corners, fill) => page.area(&corners, fill),
                    Shape::Disc(at, radius, fill) => page.disc(at, radius, fill, OUTLINE),
                    Shape::Words(words, at, size, ink) => page.words(&words, at, size, ink),
                }
            }
        })
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

/// A filled polygon with an outline.
fn outlined(corners: Vec<[f64; 2]>, fill: Rgb) -> Vec<Shape> {
    let closed = corners.iter().chain(corners.first()).copied().collect();
    vec![Shape::Area(corners, fill), Shape::Line(closed, OUTLINE)]
}

/// A line through points of the page that ends in a head.
fn arrow(points: &[[f64; 2]], color: Rgb) -> Vec<Shape> {
    let pen = Pen {
        color,
        width: 2.0,
        dashed: false,
    };
    let mut part = vec![Shape::Line(points.to_vec(), pen)];
    if let [.., a, b] = points {
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0].hypot(along[1]).max(1e-9);
        let [dx, dy] = along.map(|c| c / length);
        let corner = |side: f64| {
            [
                b[0] - 9.0 * dx - side * 4.0 * dy,
                b[1] - 9.0 * dy + side * 4.0 * dx,
            ]
        };
        let tip = [b[0] + 2.0 * dx, b[1] + 2.0 * dy];
        part.push(Shape::Area(vec![tip, corner(1.0), corner(-1.0)], color));
    }
    part
}
