//! The built-in kinds of joint, one file each.

mod cylindrical;
mod fixed;
#[cfg(test)]
mod oracle;
mod planar;
mod prismatic;
mod revolute;
mod screw;
mod spherical;
mod universal;

pub use cylindrical::Cylindrical;
pub use fixed::Fixed;
pub use planar::Planar;
pub use prismatic::Prismatic;
pub use revolute::Revolute;
pub use screw::Screw;
pub use spherical::Spherical;
pub use universal::Universal;
