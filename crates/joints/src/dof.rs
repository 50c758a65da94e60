//! The six directions of a joint frame or of the global frame, and sets of them.

use std::fmt;
use std::str::FromStr;

use crate::error::JointError;

/// One of six directions: translations `X Y Z` along, rotations `U V W` about x, y, z.
///
/// In a joint frame it names a direction of relative motion. In the global frame it names a
/// component of a displacement `Δx Δy Δz φx φy φz` (or of a wrench `Fx Fy Fz Mx My Mz`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Dof {
    /// Translation along x.
    X,
    /// Translation along y.
    Y,
    /// Translation along z.
    Z,
    /// Rotation about x.
    U,
    /// Rotation about y.
    V,
    /// Rotation about z.
    W,
}

impl Dof {
    /// All six, in the order of the components of a displacement.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::U, Self::V, Self::W];

    /// Place in a displacement or wrench vector, 0 to 5.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Whether it is a rotation.
    pub const fn is_rotation(self) -> bool {
        self.index() >= 3
    }

    /// The name: `"x"`, `"y"`, `"z"`, `"u"`, `"v"` or `"w"`.
    pub const fn name(self) -> &'static str {
        ["x", "y", "z", "u", "v", "w"][self.index()]
    }
}

impl fmt::Display for Dof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Dof {
    type Err = JointError;

    /// Reads the name of a direction, in lower case.
    fn from_str(text: &str) -> Result<Self, JointError> {
        Self::ALL
            .into_iter()
            .find(|dof| dof.name() == text)
            .ok_or_else(|| JointError::UnknownDirection { text: text.into() })
    }
}

/// A set of directions.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct DofSet(u8);

impl DofSet {
    /// No direction.
    pub const EMPTY: Self = Self(0);
    /// All six directions.
    pub const ALL: Self = Self(0b11_1111);

    /// The set of `directions`; repeated ones count once.
    pub const fn new(directions: &[Dof]) -> Self {
        let mut bits = 0;
        let mut k = 0;
        while k < directions.len() {
            bits |= 1 << directions[k].index();
            k += 1;
        }
        Self(bits)
    }

    /// Whether `dof` is in the set.
    pub const fn contains(self, dof: Dof) -> bool {
        self.0 & (1 << dof.index()) != 0
    }

    /// Adds `dof`.
    pub fn insert(&mut self, dof: Dof) {
        self.0 |= 1 << dof.index();
    }

    /// Takes `dof` out.
    pub fn remove(&mut self, dof: Dof) {
        self.0 &= !(1 << dof.index());
    }

    /// What is in either set.
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What is in both sets.
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// What is in this set and not in `other`.
    pub const fn difference(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// What is not in this set.
    pub const fn complement(self) -> Self {
        Self::ALL.difference(self)
    }

    /// Number of directions.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Bit d is set where the direction of index d is in the set.
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// The directions in ascending order.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = Dof> + Clone {
        Dof::ALL.into_iter().filter(move |&dof| self.contains(dof))
    }
}

impl FromIterator<Dof> for DofSet {
    fn from_iter<I: IntoIterator<Item = Dof>>(directions: I) -> Self {
        let mut set = Self::EMPTY;
        for dof in directions {
            set.insert(dof);
        }
        set
    }
}

impl fmt::Debug for DofSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

/// The names of the directions with a space between them; `–` for the empty set.
impl fmt::Display for DofSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("–");
        }
        for (k, dof) in self.iter().enumerate() {
            let space = if k == 0 { "" } else { " " };
            write!(f, "{space}{dof}")?;
        }
        Ok(())
    }
}
