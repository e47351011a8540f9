//! Ray forms: sums of powers of the distance from a centre, each with a coefficient that depends on the direction alone; and what sums,
//! products and powers of them are. Knows no node of the function itself.

use std::rc::Rc;

use super::poly::Sums;
use crate::field::NodeId;

/// Terms of a form at most.
pub const TERMS: usize = 16;
/// Degrees this close are one: relative, and absolute below 1.
const SAME: f64 = 1e-12;

/// The power of the distance: a number, or a number of times an exponent that depends on the direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Degree {
    /// The number.
    pub value: f64,
    /// The exponent that it multiplies, in the graph of the coefficients.
    pub of: Option<NodeId>,
}

impl Degree {
    pub(super) const ZERO: Self = Self { value: 0.0, of: None };

    pub(super) fn number(value: f64) -> Self {
        Self { value, of: None }
    }

    pub(super) fn is_zero(self) -> bool {
        self.value == 0.0
    }

    pub(super) fn is_same(self, other: Self) -> bool {
        let scale = self.value.abs().max(other.value.abs()).max(1.0);
        self.of == other.of && (self.value - other.value).abs() <= SAME * scale
    }

    /// The sum, unless one varies with the direction and the other does not go with it.
    pub(super) fn plus(self, other: Self, sign: f64) -> Option<Self> {
        if self.is_zero() {
            return Some(Self { value: sign * other.value, of: other.of });
        }
        if other.is_zero() {
            return Some(self);
        }
        let sum = Self { value: self.value + sign * other.value, of: self.of };
        (self.of == other.of).then(|| if sum.is_same(Self { value: 0.0, of: self.of }) { Self::ZERO } else { sum })
    }
}

/// `A t^k`: a coefficient in the graph of the coefficients, and a degree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// The power of t.
    pub degree: Degree,
    /// Its coefficient, a function of the direction.
    pub coefficient: NodeId,
}

/// A sum of terms by ascending degree, none twice; without terms it is zero.
#[derive(Clone, Debug, PartialEq)]
pub struct RayForm(Rc<[Term]>);

impl RayForm {
    pub(super) fn zero() -> Self {
        Self(Rc::new([]))
    }

    pub(super) fn one(degree: Degree, coefficient: NodeId) -> Self {
        Self(Rc::new([Term { degree, coefficient }]))
    }

    pub(super) fn new(mut terms: Vec<Term>) -> Self {
        terms.sort_by(|a, b| a.degree.value.total_cmp(&b.degree.value));
        Self(terms.into())
    }

    /// Its terms, lowest degree first.
    #[must_use]
    pub fn terms(&self) -> &[Term] {
        &self.0
    }

    /// Whether it is the same everywhere on a ray: its value there, `None` for zero.
    pub(super) fn constant(&self) -> Option<Option<NodeId>> {
        match self.terms() {
            [] => Some(None),
            [only] if only.degree.is_zero() => Some(Some(only.coefficient)),
            _ => None,
        }
    }
}

impl Sums {
    /// The coefficient of a form of one term or none.
    pub(super) fn coefficient(&mut self, form: &RayForm) -> NodeId {
        match form.terms().first() {
            Some(term) => term.coefficient,
            None => self.constant(0.0),
        }
    }

    pub(super) fn negated(&mut self, form: &RayForm) -> RayForm {
        RayForm::new(form.terms().iter().map(|t| Term { coefficient: self.neg(t.coefficient), ..*t }).collect())
    }

    /// The form with its coefficients in fewer operations, where that is easy.
    pub(super) fn tidied(&mut self, form: &RayForm) -> RayForm {
        RayForm::new(form.terms().iter().map(|t| Term { coefficient: self.tidy(t.coefficient), ..*t }).collect())
    }

    /// The sum. `None` if there are too many terms.
    pub(super) fn sum(&mut self, a: &RayForm, b: &RayForm) -> Option<RayForm> {
        let mut terms = a.terms().to_vec();
        for term in b.terms() {
            let Some(at) = terms.iter().position(|t| t.degree.is_same(term.degree)) else {
                terms.push(*term);
                continue;
            };
            let before = terms[at].coefficient;
            match self.add(before, term.coefficient) {
                Some(sum) => terms[at].coefficient = sum,
                None => {
                    terms.remove(at);
                }
            }
        }
        (terms.len() <= TERMS).then(|| RayForm::new(terms))
    }

    /// The product. `None` if there are too many terms, or degrees that do not add.
    pub(super) fn product(&mut self, a: &RayForm, b: &RayForm) -> Option<RayForm> {
        if a.terms().is_empty() || b.terms().is_empty() {
            let other = if a.terms().is_empty() { b } else { a };
            other.terms().iter().for_each(|t| self.drop_coefficient(t.coefficient));
            return Some(RayForm::zero());
        }
        let mut sum = RayForm::zero();
        for s in a.terms() {
            let mut row = Vec::with_capacity(b.terms().len());
            for t in b.terms() {
                let coefficient = self.multiply(s.coefficient, t.coefficient);
                row.push(Term { degree: s.degree.plus(t.degree, 1.0)?, coefficient });
            }
            sum = self.sum(&sum, &RayForm::new(row))?;
        }
        Some(sum)
    }

    /// The quotient by one term.
    pub(super) fn quotient(&mut self, a: &RayForm, b: Term) -> Option<RayForm> {
        let mut terms = Vec::with_capacity(a.terms().len());
        for t in a.terms() {
            let coefficient = self.divide(t.coefficient, b.coefficient);
            terms.push(Term { degree: t.degree.plus(b.degree, -1.0)?, coefficient });
        }
        Some(RayForm::new(terms))
    }
}
