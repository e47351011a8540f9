//! Colours for values: maps from 0..=1 to sRGB, by name. Draws nothing.

/// A map from a number in 0..=1 to a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Palette {
    /// The house's own: a light grey-blue solid, blue for what is inside a plot.
    #[default]
    Plain,
    /// Black inside, white outside.
    Mono,
    /// The colours of the spectrum, from violet to red.
    Spectrum,
    /// Dark violet over green to yellow: even steps of lightness, also for those who do not tell red from green.
    Viridis,
    /// Black over red and orange to light yellow.
    Embers,
    /// Blue over white to red: for values of both signs.
    Diverging,
    /// Black to white.
    Grey,
}

impl Palette {
    /// The palettes by their names.
    pub const NAMES: [(&'static str, Self); 7] = [
        ("plain", Self::Plain),
        ("mono", Self::Mono),
        ("spectrum", Self::Spectrum),
        ("viridis", Self::Viridis),
        ("embers", Self::Embers),
        ("diverging", Self::Diverging),
        ("grey", Self::Grey),
    ];

    /// The palette of that name, in any case.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|&(_, palette)| palette)
    }

    /// The colour at `t`; outside of 0..=1 that of the nearer end, for NaN a light grey.
    #[must_use]
    pub fn colour(self, t: f64) -> [u8; 3] {
        if t.is_nan() {
            return [0xd8, 0xd8, 0xd8];
        }
        let stops = self.stops();
        let place = t.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let low = (place as usize).min(stops.len() - 2);
        let part = place - low as f64;
        std::array::from_fn(|k| {
            let (a, b) = (f64::from(stops[low][k]), f64::from(stops[low + 1][k]));
            (a + part * (b - a)).round() as u8
        })
    }

    /// Colours at equal steps, at least two.
    fn stops(self) -> &'static [[u8; 3]] {
        match self {
            Self::Plain => {
                &[[0xe8, 0xee, 0xf5], [0xb4, 0xca, 0xe2], [0x7a, 0xa2, 0xcc], [0x45, 0x78, 0xae], [0x1f, 0x4e, 0x86]]
            }
            Self::Mono => &[[255, 255, 255], [0, 0, 0]],
            Self::Spectrum => &[
                [0x5e, 0x2a, 0xa8],
                [0x2b, 0x4f, 0xd8],
                [0x10, 0x9a, 0xd6],
                [0x14, 0xb8, 0x8e],
                [0x5c, 0xc4, 0x2f],
                [0xd8, 0xd0, 0x1e],
                [0xf2, 0x9a, 0x16],
                [0xdc, 0x2f, 0x20],
            ],
            Self::Viridis => &[
                [0x44, 0x06, 0x54],
                [0x46, 0x31, 0x7e],
                [0x36, 0x5b, 0x8c],
                [0x27, 0x80, 0x8e],
                [0x20, 0xa3, 0x86],
                [0x54, 0xc4, 0x66],
                [0xa6, 0xdb, 0x37],
                [0xfc, 0xe6, 0x28],
            ],
            Self::Embers => &[
                [8, 4, 10],
                [0x5a, 0x10, 0x2c],
                [0xb2, 0x2a, 0x22],
                [0xea, 0x6a, 0x16],
                [0xf9, 0xb5, 0x3c],
                [0xfd, 0xf4, 0xc4],
            ],
            Self::Diverging => {
                &[[0x2a, 0x55, 0xa5], [0x8a, 0xb3, 0xde], [0xf5, 0xf4, 0xf2], [0xee, 0xa2, 0x86], [0xb0, 0x2a, 0x30]]
            }
            Self::Grey => &[[0, 0, 0], [255, 255, 255]],
        }
    }

    /// The colour of a solid whose look this palette decides.
    #[must_use]
    pub fn solid(self) -> [u8; 3] {
        match self {
            Self::Plain => [0xc3, 0xce, 0xdb],
            Self::Mono | Self::Grey => [0xc8, 0xc8, 0xc8],
            other => other.colour(0.62),
        }
    }
}

/// The linear light of an sRGB byte, 0..=1.
#[must_use]
pub fn linear(byte: u8) -> f32 {
    bright(f64::from(byte) / 255.0)
}

/// The linear light of a component of an sRGB colour, both 0..=1.
#[must_use]
pub fn bright(v: f64) -> f32 {
    let light = if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) };
    light as f32
}

/// The sRGB byte of a linear light; what is brighter than white is white.
#[must_use]
pub fn encode(light: f32) -> u8 {
    let v = f64::from(light.clamp(0.0, 1.0));
    let code = if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * libm::pow(v, 1.0 / 2.4) - 0.055 };
    (code * 255.0).round() as u8
}
