//! The values of options: how they are written and what they must be. Each refusal says what would do.

/// Slices that one output may have.
const MOST_SLICES: usize = 10_000;

/// `-D NAME=EXPR`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The name.
    pub name: String,
    /// The expression, as written.
    pub expression: String,
}

/// `--at x4=0.5`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// The coordinate, from 1 to 16.
    pub coordinate: u8,
    /// The value that it is held at.
    pub value: f64,
}

/// `--bounds x1=-2:2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The coordinate, from 1 to 16.
    pub coordinate: u8,
    /// The smallest value.
    pub lo: f64,
    /// The largest value, above `lo`.
    pub hi: f64,
}

/// `--slices x3=LO:HI:N`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slices {
    /// The coordinate, from 1 to 16.
    pub coordinate: u8,
    /// Where the first slice is.
    pub lo: f64,
    /// Where the last slice is, not below `lo`.
    pub hi: f64,
    /// How many, at least 1.
    pub count: usize,
}

impl Slices {
    /// Where the slices are: both ends and equal steps between; one alone is at `lo`.
    #[must_use]
    pub fn places(&self) -> Vec<f64> {
        let part = |k: usize| k as f64 / (self.count.max(2) - 1) as f64;
        (0..self.count).map(|k| self.lo + part(k) * (self.hi - self.lo)).collect()
    }
}

/// `--size WxH`, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Columns, at least 1.
    pub width: usize,
    /// Rows, at least 1.
    pub height: usize,
}

/// Reads `NAME=EXPR`.
pub fn assignment(text: &str) -> Result<Assignment, String> {
    let (name, expression) = split(text, '=', "NAME=EXPR, as in r1=4")?;
    let legal = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    if !legal {
        return Err(format!("`{name}` is not a name"));
    }
    Ok(Assignment { name: name.into(), expression: expression.into() })
}

/// Reads `x4=0.5`.
pub fn section(text: &str) -> Result<Section, String> {
    let (name, value) = split(text, '=', "xN=VALUE, as in x4=0.5")?;
    Ok(Section { coordinate: coordinate(name)?, value: finite(value)? })
}

/// Reads `x1=-2:2`.
pub fn extent(text: &str) -> Result<Extent, String> {
    let form = "xN=LO:HI, as in x1=-2:2";
    let (name, range) = split(text, '=', form)?;
    let (lo, hi) = split(range, ':', form)?;
    let extent = Extent { coordinate: coordinate(name)?, lo: finite(lo)?, hi: finite(hi)? };
    if extent.lo < extent.hi { Ok(extent) } else { Err(format!("no extent: {lo} is not below {hi}")) }
}

/// Reads `x3=-2:2:5`.
pub fn slices(text: &str) -> Result<Slices, String> {
    let form = "xN=LO:HI:N, as in x3=-2:2:5";
    let (name, range) = split(text, '=', form)?;
    let (lo, rest) = split(range, ':', form)?;
    let (hi, count) = split(rest, ':', form)?;
    let slices = Slices { coordinate: coordinate(name)?, lo: finite(lo)?, hi: finite(hi)?, count: positive(count)? };
    if slices.count > MOST_SLICES {
        return Err(format!("{count} slices are more than {MOST_SLICES}"));
    }
    if slices.lo <= slices.hi { Ok(slices) } else { Err(format!("{lo} is above {hi}")) }
}

/// Reads `640x480`.
pub fn size(text: &str) -> Result<Size, String> {
    let lower = text.replace(['X', '\u{d7}'], "x");
    let (width, height) = split(&lower, 'x', "WIDTHxHEIGHT, as in 640x480")?;
    Ok(Size { width: positive(width)?, height: positive(height)? })
}

/// Reads `35,24`: degrees around and above, the second from -90 to 90.
pub fn angles(text: &str) -> Result<[f64; 2], String> {
    let (around, above) = split(text, ',', "AROUND,ABOVE in degrees, as in 35,24")?;
    let (around, above) = (finite(around)?, finite(above)?);
    if above.abs() <= 90.0 { Ok([around, above]) } else { Err(format!("{above} is not from -90 to 90 degrees")) }
}

/// Reads a whole number from 1.
pub fn positive(text: &str) -> Result<usize, String> {
    match text.trim().parse() {
        Ok(0) => Err("it must be at least 1".into()),
        Ok(number) => Ok(number),
        Err(_) => Err(format!("`{text}` is not a whole number from 1")),
    }
}

fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("`{text}` is not a number")),
    }
}

fn coordinate(name: &str) -> Result<u8, String> {
    let digits = name.trim().strip_prefix(['x', 'X']);
    match digits.and_then(|digits| digits.parse().ok()) {
        Some(number @ 1..=16) => Ok(number),
        _ => Err(format!("`{name}` is not a coordinate; they are x1, x2, ... x16")),
    }
}

fn split<'t>(text: &'t str, mark: char, form: &str) -> Result<(&'t str, &'t str), String> {
    match text.split_once(mark) {
        Some((left, right)) if !left.trim().is_empty() && !right.trim().is_empty() => Ok((left.trim(), right.trim())),
        _ => Err(format!("expected {form}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read() {
        assert_eq!(assignment("r1 = 2+3").map(|a| (a.name, a.expression)), Ok(("r1".into(), "2+3".into())));
        assert_eq!(section("x4=.5"), Ok(Section { coordinate: 4, value: 0.5 }));
        assert_eq!(extent("x1=-2:2e1"), Ok(Extent { coordinate: 1, lo: -2.0, hi: 20.0 }));
        assert_eq!(slices("x3=-1:1:5").map(|s| s.places()), Ok(vec![-1.0, -0.5, 0.0, 0.5, 1.0]));
        assert_eq!(slices("x3=2:2:1").map(|s| s.places()), Ok(vec![2.0]));
        assert_eq!(size("3x4"), Ok(Size { width: 3, height: 4 }));
        assert_eq!(angles("120,-30"), Ok([120.0, -30.0]));
    }

    #[test]
    fn refusals_say_what_would_do() {
        let cases: [(Result<(), String>, &str); 11] = [
            (assignment("r1").map(drop), "expected NAME=EXPR"),
            (assignment("1r=2").map(drop), "`1r` is not a name"),
            (section("x17=1").map(drop), "x1, x2, ... x16"),
            (section("x1=inf").map(drop), "`inf` is not a number"),
            (extent("x1=2:2").map(drop), "2 is not below 2"),
            (extent("x1=2").map(drop), "expected xN=LO:HI"),
            (slices("x3=0:1").map(drop), "expected xN=LO:HI:N"),
            (slices("x3=1:0:2").map(drop), "1 is above 0"),
            (slices("x3=0:1:100000").map(drop), "more than 10000"),
            (size("0x4").map(drop), "at least 1"),
            (angles("1,91").map(drop), "-90 to 90"),
        ];
        for (result, words) in cases {
            let message = result.expect_err(words);
            assert!(message.contains(words), "{message:?} does not say {words:?}");
        }
    }
}
