//! The values of options: how they are written and what they must be. Each refusal says what would do.

use crate::field::Coordinate;
use crate::model::request::{Background, Cut, Half};
use crate::syntax::scan::{Scanner, TokenKind};

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

/// `--camera 35,24`: degrees around and above; or `4,-5,3`, the place of the eye.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera(pub Vec<f64>);

impl std::fmt::Display for Camera {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let all: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&all.join(","))
    }
}

/// `--background white`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ground(pub Background);

impl std::fmt::Display for Ground {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Background::Transparent => f.write_str("transparent"),
            Background::Colour([r, g, b]) => write!(f, "#{r:02x}{g:02x}{b:02x}"),
        }
    }
}

/// `--cut x1=0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutting(pub Cut);

impl std::fmt::Display for Cutting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Cut { coordinate, value, keep } = self.0;
        let mark = match keep {
            None => '=',
            Some(Half::Below) => '<',
            Some(Half::Above) => '>',
        };
        write!(f, "{coordinate}{mark}{value}")
    }
}

/// Reads `NAME=EXPR`.
pub fn assignment(text: &str) -> Result<Assignment, String> {
    let (name, expression) = split(text, '=', "NAME=EXPR, as in r1=4")?;
    let legal = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    if !legal {
        return Err(format!("`{name}` is not a name"));
    }
    if Scanner::new(expression, 0, expression.len()).any(|token| token.kind == TokenKind::Semicolon) {
        return Err("one expression gives one value: for more, give -D again, without `;`".into());
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

/// Reads `35,24`, degrees around and above, or `4,-5,3`, a point.
pub fn camera(text: &str) -> Result<Camera, String> {
    if text.split(',').count() == 3 {
        return text.split(',').map(finite).collect::<Result<_, _>>().map(Camera);
    }
    angles(text).map(|angles| Camera(angles.into())).map_err(|told| {
        if told.starts_with("expected") {
            "expected AROUND,ABOVE in degrees, as in 35,24, or X,Y,Z".into()
        } else {
            told
        }
    })
}

/// Reads `white`, `#ffcc00` or `transparent`.
pub fn background(text: &str) -> Result<Ground, String> {
    Background::from_name(text).map(Ground).ok_or_else(|| {
        format!("`{text}` is no background: expected a colour, {} or #rrggbb, or `transparent`", Background::NAMES)
    })
}

/// Reads `x1=0`, `x1<0` or `x1>0`.
pub fn cut(text: &str) -> Result<Cutting, String> {
    let form = "xN=VALUE, xN<VALUE or xN>VALUE, as in x1=0";
    let mark = text.find(['=', '<', '>']).and_then(|at| text[at..].chars().next()).ok_or(format!("expected {form}"))?;
    let (name, value) = split(text, mark, form)?;
    let keep = match mark {
        '<' => Some(Half::Below),
        '>' => Some(Half::Above),
        _ => None,
    };
    // `x1<=0` means the same: the plane belongs to both halves.
    let value = if keep.is_some() { value.strip_prefix('=').unwrap_or(value) } else { value };
    Ok(Cutting(Cut { coordinate: Coordinate(coordinate(name)?), value: finite(value)?, keep }))
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
        assert_eq!(camera("120,-30"), Ok(Camera(vec![120.0, -30.0])));
        assert_eq!(camera("4,-5,3").map(|c| c.to_string()), Ok("4,-5,3".into()));
        assert_eq!(background("#FFcc00"), Ok(Ground(Background::Colour([255, 204, 0]))));
        assert_eq!(background("Transparent"), Ok(Ground(Background::Transparent)));
        let half = |text: &str| cut(text).map(|c| (c.0.coordinate.0, c.0.value, c.0.keep));
        assert_eq!(half("x1=-.5"), Ok((1, -0.5, None)));
        assert_eq!(half("x2 < 3"), Ok((2, 3.0, Some(Half::Below))));
        assert_eq!(half("x3>=0"), Ok((3, 0.0, Some(Half::Above))));
    }

    #[test]
    fn refusals_say_what_would_do() {
        let cases: [(Result<(), String>, &str); 16] = [
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
            (camera("1").map(drop), "or X,Y,Z"),
            (camera("1,2,x").map(drop), "`x` is not a number"),
            (background("#12345").map(drop), "#rrggbb"),
            (cut("x1").map(drop), "expected xN=VALUE"),
            (cut("x17<2").map(drop), "x1, x2, ... x16"),
        ];
        for (result, words) in cases {
            let message = result.expect_err(words);
            assert!(message.contains(words), "{message:?} does not say {words:?}");
        }
    }
}
