//! Loops whose condition differs from point to point: the body is evaluated once, with variables in the place of what it assigns, and
//! becomes a loop of the expression graph. Never unrolls; where a body needs numbers it says that it cannot.

use crate::field::Coordinate;
use crate::syntax::tree::{Expr, Name, Statement};

use super::super::value::{Array, Scalar, Value};
use super::{Fault, Lower, Lowered, Slot};

/// Numbers that a body may change, arrays counted by element.
const VARIABLES: usize = 30;

/// What changes from turn to turn.
#[derive(Default)]
struct Variables {
    /// The first values.
    first: Vec<Scalar>,
    /// The number of the first variable's coordinate.
    from: u8,
}

impl Variables {
    fn next(&mut self, first: Scalar) -> Option<Coordinate> {
        let number = self.from.checked_add(u8::try_from(self.first.len()).ok()?)?;
        if self.first.len() >= VARIABLES || usize::from(number) > Coordinate::MOST {
            return None;
        }
        self.first.push(first);
        Some(Coordinate(number))
    }
}

impl Lower<'_> {
    /// Runs a loop at each point from where its names stand; whether it could.
    pub(super) fn at_each_point(
        &mut self,
        condition: &Expr,
        body: &[Statement],
        names: &[Name],
    ) -> Lowered<bool> {
        let before = self.slots(names);
        let (warnings, turns) = (self.warnings.len(), self.turns);
        let (from, depth, calls, frame) = (self.variables, self.depth, self.calls, self.frame);
        let (locals, active, functions) = (self.locals.len(), self.active.clone(), self.current_function.len());
        let done = self.try_at_each_point(condition, body, names, &before);
        self.variables = from;
        if let Ok(true) = done {
            return Ok(true);
        }
        // An error leaves everything as it stood inside.
        (self.depth, self.calls, self.frame, self.active) = (depth, calls, frame, active);
        self.locals.truncate(locals);
        self.current_function.truncate(functions);
        self.put_slots(names, before);
        self.warnings.truncate(warnings);
        self.turns = turns;
        match done {
            Err(Fault::Cancelled) => Err(Fault::Cancelled),
            // What is wrong is told when the turns are taken one by one.
            _ => Ok(false),
        }
    }

    fn try_at_each_point(
        &mut self,
        condition: &Expr,
        body: &[Statement],
        names: &[Name],
        before: &[Slot],
    ) -> Lowered<bool> {
        let mut variables = Variables { first: Vec::new(), from: self.variables + 1 };
        let mut placed = Vec::with_capacity(before.len());
        for slot in before {
            placed.push(match slot {
                Slot::Is(value) => match self.vary(value, &mut variables) {
                    Some(value) => Slot::Is(value),
                    None => return Ok(false),
                },
                other => other.clone(),
            });
        }
        self.put_slots(names, placed.clone());
        self.variables += u8::try_from(variables.first.len()).unwrap_or(0);
        let condition = self.scalar(condition, "the condition of a loop")?;
        self.block(body)?;
        let after = self.slots(names);
        let mut next = Vec::new();
        for (placed, after) in placed.iter().zip(&after) {
            if let (Slot::Is(placed), Slot::Is(after)) = (placed, after)
                && !pair(placed, after, &mut next)
            {
                return Ok(false);
            }
        }
        // What is assigned before it is read starts undefined.
        let mut ends = Vec::with_capacity(after.len());
        for (placed, after) in placed.iter().zip(&after) {
            ends.push(match (placed, after) {
                (Slot::Unset, Slot::Is(value)) => {
                    let Some(value) = self.late(value, &mut variables, &mut next) else { return Ok(false) };
                    Slot::Is(value)
                }
                (Slot::Failed(_), _) | (_, Slot::Failed(_)) => return Ok(false),
                (placed, _) => placed.clone(),
            });
        }
        let condition = condition.node(self.graph);
        let mut all = Vec::with_capacity(next.len());
        for (i, next) in (0u8..).zip(next) {
            let first = variables.first[usize::from(i)].node(self.graph);
            all.push((Coordinate(variables.from + i), first, next.node(self.graph)));
        }
        let Ok(outputs) = self.graph.repeat(condition, &all, self.world.limits.program_operations) else {
            return Ok(false);
        };
        let outputs: Vec<Scalar> = outputs.into_iter().map(|id| self.wrap(id)).collect();
        let ends = ends
            .into_iter()
            .map(|slot| match slot {
                Slot::Is(value) => Slot::Is(self.ended(&value, variables.from, &outputs)),
                other => other,
            })
            .collect();
        self.put_slots(names, ends);
        Ok(true)
    }

    /// The value with a variable in the place of each scalar.
    fn vary(&mut self, value: &Value, variables: &mut Variables) -> Option<Value> {
        match value {
            Value::Scalar(scalar) => {
                let variable = variables.next(*scalar)?;
                Some(Value::Scalar(Scalar::Node(self.graph.coordinate(variable))))
            }
            Value::Array(array) => {
                if array.elements() > VARIABLES {
                    return None;
                }
                let items: Option<Vec<Value>> = array.items().iter().map(|v| self.vary(v, variables)).collect();
                Some(Value::Array(Array::new(items?).into()))
            }
            other => Some(other.clone()),
        }
    }

    /// Variables for a value that only the body gives.
    fn late(&mut self, value: &Value, variables: &mut Variables, next: &mut Vec<Scalar>) -> Option<Value> {
        match value {
            Value::Scalar(scalar) => {
                let variable = variables.next(Scalar::Number(f64::NAN))?;
                next.push(*scalar);
                Some(Value::Scalar(Scalar::Node(self.graph.coordinate(variable))))
            }
            Value::Array(array) if array.elements() <= VARIABLES => {
                let items: Option<Vec<Value>> = array.items().iter().map(|v| self.late(v, variables, next)).collect();
                Some(Value::Array(Array::new(items?).into()))
            }
            Value::Array(_) => None,
            other => Some(other.clone()),
        }
    }

    /// The value with the output of the loop in the place of each variable.
    fn ended(&self, value: &Value, from: u8, outputs: &[Scalar]) -> Value {
        match value {
            Value::Scalar(Scalar::Node(id)) => {
                let variable = self.graph.coordinates(*id).iter().next();
                let place = variable.and_then(|c| c.0.checked_sub(from)).map_or(0, usize::from);
                Value::Scalar(outputs.get(place).copied().unwrap_or(Scalar::Number(f64::NAN)))
            }
            Value::Array(array) => {
                let items = array.items().iter().map(|v| self.ended(v, from, outputs)).collect();
                Value::Array(Array::new(items).into())
            }
            other => other.clone(),
        }
    }
}

/// The scalars of the value after a turn, in the order of the variables; whether it has the same form as before.
fn pair(before: &Value, after: &Value, next: &mut Vec<Scalar>) -> bool {
    match (before, after) {
        (Value::Scalar(_), Value::Scalar(scalar)) => {
            next.push(*scalar);
            true
        }
        (Value::Array(a), Value::Array(b)) => {
            a.items().len() == b.items().len() && a.items().iter().zip(b.items()).all(|(a, b)| pair(a, b, next))
        }
        (a, b) => a.same(b),
    }
}
