//! Indexing, element assignment, and the built-ins whose arguments are arrays.

use std::sync::Arc;

use crate::builtins::{Builtin, Special};
use crate::number::{Algebra, Binary, Ternary, Unary};
use crate::source::Span;
use crate::syntax::tree::{Expr, ExprKind, Ident};

use super::super::errors;
use super::super::value::{Array, Scalar, Value};
use super::{Lower, Lowered, Slot};

/// Elements among which an index that depends on a coordinate may choose.
const CHOICES: usize = 10_000;

impl Lower<'_> {
    /// `base[i, j]`.
    pub(super) fn index(&mut self, base: &Expr, indices: &[Expr]) -> Lowered<Value> {
        let mut value = self.expr(base)?;
        for e in indices {
            let Value::Array(array) = &value else { return Err(errors::not_an_array(&value, base.span).into()) };
            let array = array.clone();
            value = match self.scalar(e, "an index")? {
                Scalar::Number(i) => match whole_index(i, array.items().len()) {
                    Some(place) => array.items()[place].clone(),
                    None => return Err(self.bad_index(i, &array, base, e.span)),
                },
                Scalar::Node(_) if array.items().len() > CHOICES => {
                    return Err(errors::too_many_choices(CHOICES, e.span).into());
                }
                i @ Scalar::Node(_) => self.choose_item(i, array.items(), e.span)?,
            };
        }
        Ok(value)
    }

    fn bad_index(&self, i: f64, array: &Array, base: &Expr, span: Span) -> super::Fault {
        let mut told = errors::bad_index(i, array.items().len(), span);
        if let ExprKind::Name(name) = &base.kind
            && let Some(definition) = self.state.get(name)
        {
            told = told.see(definition.place(), format!("`{name}` has {} elements", array.items().len()));
        }
        told.into()
    }

    /// The item at an index that differs from point to point; undefined where there is none.
    fn choose_item(&mut self, i: Scalar, items: &[Value], span: Span) -> Lowered<Value> {
        let Some(last) = items.last() else { return Err(errors::empty_array(span).into()) };
        let mut value = self.each(last, span, &mut |_, _| Ok(Scalar::Number(f64::NAN)))?;
        for (place, item) in items.iter().enumerate().rev() {
            #[allow(clippy::cast_precision_loss)]
            let number = Scalar::Number((place + 1) as f64);
            let here = self.scalars().binary(Binary::Equal, i, number);
            value = self.select(here, item, &value, span)?;
        }
        Ok(value)
    }

    /// `name[i] = value`: changes the local array.
    pub(super) fn element(&mut self, name: &Ident, indices: &[Expr], value: &Expr) -> Lowered<()> {
        let new = self.expr(value)?;
        if matches!(new, Value::Text(_) | Value::Function(_)) {
            return Err(errors::not_an_element(&new, value.span).into());
        }
        let mut path = Vec::with_capacity(indices.len());
        for e in indices {
            path.push((self.number(e, "the index of an assignment")?, e.span));
        }
        let limits = self.world.limits.array_elements;
        let frame = self.frame;
        let Some(local) = self.locals[frame..].iter_mut().rev().find(|l| l.name == name.name) else {
            return Err(errors::read_before_assigned(&name.name, name.span).into());
        };
        match &mut local.slot {
            Slot::Is(target) => {
                assign(target, &path, new, name)?;
                match target {
                    Value::Array(a) if a.elements() > limits => Err(errors::array_too_large(limits, name.span).into()),
                    Value::Array(a) if a.depth() > super::super::value::ARRAY_DEPTH => {
                        Err(errors::array_too_deep(super::super::value::ARRAY_DEPTH, name.span).into())
                    }
                    _ => Ok(()),
                }
            }
            Slot::Failed(told) => Err(super::Fault::Follows(told.clone())),
            Slot::Unset => Err(errors::element_of_nothing(&name.name, name.span).into()),
        }
    }

    /// The built-ins over arrays of numbers.
    pub(super) fn vectors(
        &mut self,
        form: Special,
        builtin: &Builtin,
        arguments: &[Expr],
        span: Span,
    ) -> Lowered<Value> {
        let mut arrays = Vec::with_capacity(arguments.len());
        for e in arguments {
            match self.expr(e)? {
                Value::Array(array) => arrays.push(array),
                other => return Err(errors::wrong_builtin_kind(builtin, &other, "an array", e.span).into()),
            }
        }
        match (form, &arrays[..]) {
            #[allow(clippy::cast_precision_loss)]
            (Special::Len, [a]) => Ok(Value::number(a.items().len() as f64)),
            (Special::Join, _) => self.array(arrays.iter().flat_map(|a| a.items().iter().cloned()).collect(), span),
            (Special::Dot, [a, b]) => {
                if a.items().len() != b.items().len() {
                    let (at, bt) = (arguments[0].span, arguments[1].span);
                    return Err(errors::lengths_differ(a.items().len(), b.items().len(), at, bt).into());
                }
                self.dot(a, b, span).map(Value::Scalar)
            }
            (Special::Cross, [a, b]) => self.cross(a, b, arguments, span),
            (Special::Norm, [a]) => {
                let squares = self.dot(a, a, span)?;
                Ok(Value::Scalar(self.scalars().unary(Unary::Sqrt, squares)))
            }
            _ => Err(errors::wrong_builtin_count(builtin, arrays.len(), span).into()),
        }
    }

    fn dot(&mut self, a: &Array, b: &Array, span: Span) -> Lowered<Scalar> {
        let mut sum: Option<Scalar> = None;
        for (x, y) in a.items().iter().zip(b.items()) {
            let x = self.as_scalar(x, span, "an element of a vector")?;
            let y = self.as_scalar(y, span, "an element of a vector")?;
            let product =
                if x == y { self.scalars().unary(Unary::Powi(2), x) } else { self.scalars().binary(Binary::Mul, x, y) };
            sum = Some(match sum {
                None => product,
                Some(sum) => self.scalars().binary(Binary::Add, sum, product),
            });
        }
        Ok(sum.unwrap_or(Scalar::Number(0.0)))
    }

    /// `PNORM(a, b, ..., p)`, or `PNORM(array, p)`: from left to right.
    pub(super) fn p_norm(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let mut values = Vec::with_capacity(arguments.len());
        for e in arguments {
            values.push(self.expr(e)?);
        }
        let Some(p) = values.pop() else { return Err(errors::wrong_builtin_count(builtin, 0, span).into()) };
        let mut places: Vec<Span> = arguments.iter().map(|e| e.span).collect();
        let p_at = places.pop().unwrap_or(span);
        let Value::Scalar(p) = p else { return Err(errors::wrong_builtin_kind(builtin, &p, "a number", p_at).into()) };
        if p == Scalar::Number(0.0) {
            return Err(errors::no_zero_norm(p_at).into());
        }
        if let [one] = &values[..] {
            values = match one {
                Value::Array(array) if !array.items().is_empty() => array.items().to_vec(),
                other => return Err(errors::wrong_builtin_kind(builtin, other, "an array", places[0]).into()),
            };
            places = vec![places[0]; values.len()];
        }
        let mut norm: Option<Scalar> = None;
        for (value, at) in values.iter().zip(places) {
            let Value::Scalar(next) = *value else {
                return Err(errors::wrong_builtin_kind(builtin, value, "a number", at).into());
            };
            norm = Some(match norm {
                None => self.scalars().unary(Unary::Abs, next),
                Some(before) => self.scalars().ternary(Ternary::Norm, before, next, p),
            });
        }
        norm.map(Value::Scalar).ok_or_else(|| errors::wrong_builtin_count(builtin, 0, span).into())
    }

    fn cross(&mut self, a: &Array, b: &Array, arguments: &[Expr], span: Span) -> Lowered<Value> {
        for (array, e) in [a, b].into_iter().zip(arguments) {
            if array.items().len() != 3 {
                return Err(errors::needs_length(3, array.items().len(), e.span).into());
            }
        }
        let mut items = Vec::with_capacity(3);
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let place = "an element of a vector";
            let (aj, ak) = (self.as_scalar(&a.items()[j], span, place)?, self.as_scalar(&a.items()[k], span, place)?);
            let (bj, bk) = (self.as_scalar(&b.items()[j], span, place)?, self.as_scalar(&b.items()[k], span, place)?);
            let mut algebra = self.scalars();
            let (left, right) = (algebra.binary(Binary::Mul, aj, bk), algebra.binary(Binary::Mul, ak, bj));
            items.push(Value::Scalar(algebra.binary(Binary::Sub, left, right)));
        }
        self.array(items, span)
    }

    /// `RANDOM(seed, i)`: the same number every time, from 0 to below 1; by element where an argument is an array.
    pub(super) fn random(&mut self, builtin: &Builtin, arguments: &[Expr]) -> Lowered<Value> {
        let (seed, i) = (&arguments[0], &arguments[1]);
        let seed = self.number(seed, "the seed of RANDOM")?;
        let value = self.expr(i)?;
        if matches!(value, Value::Text(_) | Value::Function(_)) {
            return Err(errors::wrong_builtin_kind(builtin, &value, "a number", i.span).into());
        }
        let span = i.span;
        self.each(&value, span, &mut |lower, s| match s {
            Scalar::Number(i) => Ok(Scalar::Number(random(seed, i))),
            Scalar::Node(id) => {
                Err(errors::needs_number("the index of RANDOM", lower.graph.coordinates(id), span).into())
            }
        })
    }

    /// A Select that is undefined where the condition fails.
    pub(super) fn undefined_unless(&mut self, condition: Scalar, value: Scalar) -> Scalar {
        self.scalars().ternary(Ternary::Select, condition, value, Scalar::Number(f64::NAN))
    }
}

/// The place of element `i` (from 1) among `length`.
fn whole_index(i: f64, length: usize) -> Option<usize> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
    (i.fract() == 0.0 && i >= 1.0 && i <= length as f64).then(|| i as usize - 1)
}

fn assign(target: &mut Value, path: &[(f64, Span)], new: Value, name: &Ident) -> Lowered<()> {
    let Some(((i, span), rest)) = path.split_first() else {
        *target = new;
        return Ok(());
    };
    let Value::Array(array) = target else { return Err(errors::not_an_array(target, name.span).into()) };
    let Some(place) = whole_index(*i, array.items().len()) else {
        return Err(errors::bad_index(*i, array.items().len(), *span).into());
    };
    let array = Arc::make_mut(array);
    if rest.is_empty() {
        array.set(place, new);
        return Ok(());
    }
    let mut item = std::mem::replace(array.item_mut(place), Value::number(0.0));
    let result = assign(&mut item, rest, new, name);
    *array.item_mut(place) = item;
    array.recount();
    result
}

/// SplitMix64 over the bits of both numbers.
fn random(seed: f64, i: f64) -> f64 {
    let mix = |mut z: u64| {
        z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    // Adding 0 makes -0 and 0 one seed.
    let bits = mix(mix((seed + 0.0).to_bits()) ^ (i + 0.0).to_bits());
    #[allow(clippy::cast_precision_loss)]
    let value = (bits >> 11) as f64 / (1_u64 << 53) as f64;
    value
}
