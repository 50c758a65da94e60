//! What is asked of the lanes beside the output.

/// What lanes find at a pose beside the output's stiffness and displacements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
#[non_exhaustive]
pub enum Beside {
    /// Nothing.
    #[default]
    Nothing,
    /// What joints and segments carry under wrenches on the output that are asked for pose by pose.
    Wrenches,
    /// That, and what joints and segments carry in every state: [`Prepared::forces`](crate::Prepared::forces).
    Forces,
    /// That, and what budgets are made of: [`Prepared::budgets`](crate::Prepared::budgets).
    Budgets,
}
