//! Sizes, colours and fonts of every drawing: the one place that decides how things look.
//!
//! Lengths are display pixels. The colours of ink, paper, grid and fills are written as they stand here into the
//! SVG, so that the report's style sheet can turn them for a dark page.

use plotters::style::RGBColor;

/// The back-end writes whole numbers: charts are drawn on a canvas this many times as large as shown.
pub(crate) const OVERSAMPLING: f64 = 10.0;

/// What a chart or a map is drawn on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sheet {
    /// Width of the drawing \[px\].
    pub(crate) width: f64,
    /// Height of the plotting frame \[px\].
    pub(crate) height: f64,
    /// Number of tick marks aimed at on the horizontal axis.
    pub(crate) x_ticks: usize,
    /// Number of tick marks aimed at on the vertical axis.
    pub(crate) y_ticks: usize,
}

/// A page, a screen, paper.
pub(crate) const PAGE: Sheet = Sheet { width: 760.0, height: 330.0, x_ticks: 8, y_ticks: 6 };
/// The screen of a phone of 390 px, without the margins of a page.
pub(crate) const PHONE: Sheet = Sheet { width: 358.0, height: 270.0, x_ticks: 4, y_ticks: 5 };
/// Empty border around a drawing \[px\].
pub(crate) const MARGIN: f64 = 16.0;

/// Generic family, so that no font has to be installed where the drawing is made.
pub(crate) const FONT: &str = "sans-serif";
/// Font size of titles \[px\].
pub(crate) const TITLE_SIZE: f64 = 17.0;
/// Font size of axis labels, legends and names \[px\].
pub(crate) const LABEL_SIZE: f64 = 14.0;
/// Font size of tick labels, notes and values \[px\].
pub(crate) const TICK_SIZE: f64 = 13.0;

/// How much longer than the frame is high a label along it may be \[px\].
pub(crate) const UPRIGHT_ROOM: f64 = 80.0;

/// Width of a curve \[px\].
pub(crate) const CURVE_WIDTH: f64 = 2.2;
/// Width of a curve on which another one is expected to lie \[px\].
pub(crate) const BROAD_WIDTH: f64 = 6.0;
/// Width of frames, symbols and wires \[px\].
pub(crate) const LINE_WIDTH: f64 = 1.4;
/// Width of grid lines \[px\].
pub(crate) const HAIR_WIDTH: f64 = 0.8;
/// Length of the marks between labelled ticks \[px\].
pub(crate) const MINOR_LENGTH: f64 = 4.0;
/// Width of the border in the colour of the background around a text in a chart \[px\].
pub(crate) const HALO_WIDTH: f64 = 6.0;
/// Attributes of the border around texts, which is drawn below them and is no text itself.
pub(crate) fn halo() -> String {
    let paper = PAPER.hex();
    format!("class=\"halo\" aria-hidden=\"true\" stroke=\"{paper}\" stroke-linejoin=\"round\"")
}

/// Radius of a marker \[px\].
pub(crate) const MARKER_RADIUS: f64 = 4.5;

/// A colour as three bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Colour(pub(crate) u8, pub(crate) u8, pub(crate) u8);

impl Colour {
    /// From `0xRR_GG_BB`.
    const fn of(hex: u32) -> Self {
        let [_, red, green, blue] = hex.to_be_bytes();
        Self(red, green, blue)
    }

    /// The spelling in SVG and CSS, `#RRGGBB`, as the back-end writes it too.
    pub(crate) fn hex(self) -> String {
        format!("#{:02X}{:02X}{:02X}", self.0, self.1, self.2)
    }

    pub(crate) fn rgb(self) -> RGBColor {
        RGBColor(self.0, self.1, self.2)
    }
}

/// Lines and text.
pub(crate) const INK: Colour = Colour::of(0x1F_29_33);
/// Text of second rank and reference lines.
pub(crate) const FAINT: Colour = Colour::of(0x5B_67_70);
pub(crate) const GRID: Colour = Colour::of(0xDF_E4_E8);
pub(crate) const PAPER: Colour = Colour::of(0xFF_FF_FE);
/// Filling of masses.
pub(crate) const FILL: Colour = Colour::of(0xE9_EE_F3);

/// The colours of ink, paper, grid and fills, as they stand in every drawing: a style sheet for dark pages turns them.
pub fn page_colours() -> [String; 5] {
    [INK, FAINT, GRID, PAPER, FILL].map(Colour::hex)
}

/// Colours of curves that stay apart for colour-blind eyes and on light and dark pages
/// (Okabe and Ito, Color Universal Design, 2008; without black and yellow).
const PALETTE: [u32; 7] =
    [0x00_72_B2, 0xD5_5E_00, 0x00_9E_73, 0xCC_79_A7, 0xE6_9F_00, 0x56_B4_E9, 0x8C_6D_53];

/// Colours of a family of curves from its lowest to its highest parameter, dark to bright on paper and, made brighter,
/// on a dark page: each has a contrast of 3 or so on both.
const RAMP: [u32; 5] = [0x4A_34_A4, 0x2D_66_A8, 0x1F_7F_8A, 0x4F_94_40, 0xBE_8A_10];

/// The colour at a share, 0…1, of a family of curves.
pub(crate) fn ramp_colour(share: f64) -> Colour {
    along(&RAMP, share)
}

/// The line of a limit in a map.
pub(crate) const LIMIT: Colour = Colour::of(0xC2_18_1E);

/// Colours of a map from its lowest to its highest value, dark to bright for every eye
/// (cividis; Nuñez, Anderton and Renslow, 2018).
const MAP: [u32; 9] = [
    0x00_20_4D, 0x00_33_6F, 0x39_48_6B, 0x57_5C_6D, 0x70_71_73, 0x8A_87_79, 0xA6_9D_75, 0xC4_B5_6C,
    0xFF_EA_46,
];

/// The colour of a map at a share of its range, 0…1.
pub(crate) fn map_colour(share: f64) -> Colour {
    along(&MAP, share)
}

/// The colour at a share, 0…1, of the way through colours.
fn along(colours: &[u32], share: f64) -> Colour {
    let place = share.clamp(0.0, 1.0) * (colours.len() - 1) as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place between the colours of the map"
    )]
    let first = (place.floor() as usize).min(colours.len() - 2);
    let share = place - first as f64;
    let (one, other) = (Colour::of(colours[first]), Colour::of(colours[first + 1]));
    let mixed = |one: u8, other: u8| {
        let value = (1.0 - share) * f64::from(one) + share * f64::from(other);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between two bytes"
        )]
        let byte = value.round() as u8;
        byte
    };
    Colour(mixed(one.0, other.0), mixed(one.1, other.1), mixed(one.2, other.2))
}

/// Number of different curve colours.
pub(crate) const COLOURS: usize = PALETTE.len();

/// The `index`-th curve colour; after the last one they begin again.
pub(crate) fn curve_colour(index: usize) -> Colour {
    Colour::of(PALETTE[index % COLOURS])
}

/// Colour of a reference line that belongs to the curves of this colour number, if to any.
pub(crate) fn limit_colour(index: Option<usize>) -> Colour {
    index.map_or(FAINT, curve_colour)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_spelt_as_in_css() {
        assert_eq!(INK.hex(), "#1F2933");
    }

    /// Relative luminance (IEC 61966-2-1).
    fn luminance(colour: Colour) -> f64 {
        let linear = |byte: u8| {
            let share = f64::from(byte) / 255.0;
            if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(colour.0) + 0.7152 * linear(colour.1) + 0.0722 * linear(colour.2)
    }

    #[test]
    fn ramps_rise_in_lightness_and_stand_out_on_paper() {
        let rising = |colour: fn(f64) -> Colour| {
            let all: Vec<f64> = (0..=32).map(|i| luminance(colour(f64::from(i) / 32.0))).collect();
            assert!(all.is_sorted_by(|one, next| one < next), "{all:?}");
            all
        };
        rising(map_colour);
        let contrast = |light: f64| (luminance(PAPER) + 0.05) / (light + 0.05);
        assert!(rising(ramp_colour).into_iter().all(|own| contrast(own) >= 3.0));
    }

    #[test]
    fn curve_colours_differ_and_repeat() {
        for i in 0..COLOURS {
            for j in 0..i {
                assert_ne!(curve_colour(i), curve_colour(j));
            }
        }
        assert_eq!(curve_colour(COLOURS + 1), curve_colour(1));
    }
}
