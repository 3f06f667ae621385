use super::*;
use crate::{Scale, well_formed::assert_well_formed};

fn map() -> Map {
    let (x, y): (Vec<f64>, Vec<f64>) = ((1..9).map(f64::from).collect(), vec![1.0, 10.0, 100.0]);
    let values = y.iter().flat_map(|b| x.iter().map(move |a| a + b.log10())).collect::<Vec<_>>();
    Map {
        title: "Peak force <&>".into(),
        note: "a remark".into(),
        x_label: "stiffness (MN/m)".into(),
        y_label: "damping".into(),
        y_scale: Scale::logarithmic("N s/m"),
        value_label: "peak force (kN)".into(),
        limits: vec![MapLimit {
            values: values.clone(),
            at: 4.5,
            label: "ξmax = 1".into(),
            ..MapLimit::default()
        }],
        x,
        y,
        values,
        ..Map::default()
    }
}

/// What stands between an attribute's quotes in a tag.
fn value<'t>(tag: &'t str, key: &str) -> &'t str {
    let is_key = |at: &usize| *at == 0 || tag[..*at].ends_with([' ', '\n']);
    let start = format!("{key}=\"");
    let at = tag.match_indices(&start).map(|own| own.0).find(is_key).unwrap();
    tag[at + start.len()..].split('"').next().unwrap()
}

/// The tags of a name in the groups or paths of a class.
fn tags<'t>(svg: &'t str, class: &str, name: &str) -> Vec<&'t str> {
    let own = format!("class=\"{class}\"");
    let groups = svg.split("<g ").filter(|group| group.contains(&own));
    let inner = groups.map(|group| group.split("</g>").next().unwrap());
    let opening = format!("<{name} ");
    let mut all = Vec::new();
    inner.for_each(|group| all.extend(group.split(opening.as_str()).skip(1)));
    all
}

fn points(tag: &str) -> Vec<(f64, f64)> {
    let pair = |own: &str| {
        let (x, y) = own.split_once(',').unwrap();
        (x.parse().unwrap(), y.parse().unwrap())
    };
    value(tag, "points").split_whitespace().map(pair).collect()
}

/// x·y on both axes over two decades, with a limit.
fn product() -> Map {
    let x: Vec<f64> = (0..=40).map(|at| 10_f64.powf(0.05 * f64::from(at))).collect();
    let values: Vec<f64> = x.iter().flat_map(|y| x.iter().map(move |x| x * y)).collect();
    Map {
        title: "x·y".into(),
        x_scale: Scale::logarithmic(""),
        y_scale: Scale::logarithmic(""),
        value_scale: Scale::suiting(values.iter().copied()),
        limits: vec![MapLimit {
            values: values.clone(),
            at: 200.0,
            label: "at most 200".into(),
            kept: Side::Below,
            ..MapLimit::default()
        }],
        y: x.clone(),
        x,
        values,
        ..Map::default()
    }
}

#[test]
fn a_limit_of_a_product_is_a_straight_line_on_logarithmic_axes() {
    let svg = product().svg();
    assert_well_formed(&svg);
    let frame = tags(&svg, "axes", "rect")[0];
    let number = |key: &str| -> f64 { value(frame, key).parse().unwrap() };
    let (left, top, wide, high) = (number("x"), number("y"), number("width"), number("height"));
    let lines = tags(&svg, "limits", "polyline");
    assert_eq!(lines.len(), 1);
    let along = points(lines[0]);
    assert!(along.len() > 20);
    for (x, y) in along {
        // log x + log y = log 200, each over two decades. Between neighbours 12 % apart straight lines deviate by
        // (ln 1.12)²/8 of a value, and places are rounded to 0.05 px.
        let sum = 2.0 * (x - left) / wide + 2.0 * (top + high - y) / high;
        assert!((sum - 200_f64.log10()).abs() < 0.002, "{sum}");
    }
    assert!(svg.contains("class=\"beyond\"") && svg.contains("<pattern"));
}

/// Twice the area that the closed outlines of a path enclose, those within others taken away.
fn enclosed(data: &str) -> f64 {
    let outline = |own: &str| {
        let places: Vec<f64> =
            own.trim_end_matches('Z').split(['L', ' ']).map(|own| own.parse().unwrap()).collect();
        let corners: Vec<(f64, f64)> = places.chunks(2).map(|own| (own[0], own[1])).collect();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(one, other)| one.0 * other.1 - other.0 * one.1).sum::<f64>()
    };
    let mut areas: Vec<f64> = data.split('M').skip(1).map(|own| outline(own).abs()).collect();
    areas.sort_by(f64::total_cmp);
    areas.pop().unwrap() - areas.iter().sum::<f64>()
}

#[test]
fn the_band_of_errors_around_a_limit_is_dotted() {
    let mut own = product();
    assert!(!own.svg().contains("undecided"));
    // The error is 5 % of the value: log x + log y is log 200 within log 1.05 on each side.
    own.limits[0].errors = own.values.iter().map(|own| 0.05 * own).collect();
    let svg = own.svg();
    assert_well_formed(&svg);
    assert!(svg.contains("dotted: undecided"));
    let frame = tags(&svg, "axes", "rect")[0];
    let number = |key: &str| -> f64 { value(frame, key).parse().unwrap() };
    let band = svg.split("class=\"undecided\"").nth(1).unwrap().split("/>").next().unwrap();
    assert!(band.contains("url(#open-") && !band.contains("clip-path"));
    // Between log xy = a and b of two decades each lie ((4 − a)² − (4 − b)²)/8 of the frame.
    let of = |level: f64| (4.0 - level.log10()).powi(2) / 8.0;
    let exact = (of(200.0 / 1.05) - of(200.0 / 0.95)) * number("width") * number("height");
    let found = 0.5 * enclosed(value(band, "d"));
    assert!((found - exact).abs() < 0.01 * exact, "{found} {exact}");
    for (kept, errors) in [(Side::Above, own.limits[0].errors.clone()), (Side::Below, Vec::new())] {
        let limit = MapLimit { kept, errors, ..own.limits[0].clone() };
        let is_open = kept == Side::Above;
        let svg = Map { limits: vec![limit], ..own.clone() }.svg();
        assert_eq!(svg.contains("class=\"undecided\""), is_open);
    }
}

#[test]
fn doubted_values_are_dotted_where_they_keep_the_limit() {
    let mut own = product();
    own.limits[0].doubted = vec![true; own.values.len()];
    let svg = own.svg();
    assert_well_formed(&svg);
    let dotted = svg.split("class=\"undecided\"").nth(1).unwrap().split("/>").next().unwrap();
    let clip = value(dotted, "clip-path").trim_start_matches("url(#").trim_end_matches(')');
    let clip = svg.split(&format!("id=\"{clip}\"")).nth(1).unwrap();
    // All of the frame, without what is beyond the limit.
    let beyond = svg.split("class=\"beyond\"").nth(1).unwrap();
    assert!(clip.contains(value(beyond, "d")) && clip.contains("clip-rule=\"evenodd\""));
    // Of what is exceeded there is no doubt.
    own.limits[0].at = 0.5;
    assert!(!own.svg().contains("dotted"));
    own.limits[0].at = 1e6;
    assert!(own.svg().contains("at most 200: exceeded nowhere; dotted: undecided"));
}

#[test]
fn a_line_of_equal_value_does_not_repeat_that_of_a_limit() {
    let mut own = product();
    let count = |own: &Map| tags(&own.svg(), "contours", "polyline").len();
    let all = count(&own);
    own.shown = vec![100.0];
    assert_eq!(count(&own), all - 1);
}

#[test]
fn bands_are_shades_in_their_order_and_few_paths() {
    let svg = product().svg();
    let bands = tags(&svg, "bands", "path");
    assert!((28..=BANDS).contains(&bands.len()), "{}", bands.len());
    let colours: Vec<&str> = bands.iter().map(|own| value(own, "fill")).collect();
    let shades: Vec<String> =
        (0..BANDS).map(|band| band_colour((band as f64 + 0.5) / 32.0).hex()).collect();
    let places: Vec<_> = colours.iter().map(|own| shades.iter().position(|s| s == own)).collect();
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}");
    assert!(tags(&svg, "blocks", "rect").is_empty());
    assert!(svg.len() < 120_000, "{}", svg.len());
}

#[test]
fn texts_on_a_map_do_not_cover_each_other() {
    let mut own = product();
    let limit = |at: f64| MapLimit {
        at,
        label: format!("at most {at} (of a standard with a long name)"),
        ..own.limits[0].clone()
    };
    own.limits = [20.0, 25.0, 300.0, 320.0].map(limit).to_vec();
    for (svg, width) in [(own.svg(), 760.0), (own.narrow_svg(), 358.0)] {
        assert_well_formed(&svg);
        let mut boxes: Vec<[f64; 4]> = Vec::new();
        for (class, bold) in [("labels", 1.0), ("limit-labels", 1.12)] {
            for tag in tags(&svg, class, "text") {
                let at = |key: &str| -> f64 { value(tag, key).parse().unwrap() };
                let content = tag.split('>').nth(1).unwrap().split('<').next().unwrap();
                let half = 0.5 * bold * text_width(content, theme::TICK_SIZE);
                let (x, y) = (at("x"), at("y"));
                boxes.push([x - half, x + half, y - 9.0, y + 2.0]);
            }
        }
        assert!(boxes.len() > 4, "{boxes:?}");
        for (i, a) in boxes.iter().enumerate() {
            assert!(a[0] >= 0.0 && a[1] <= width, "{a:?}");
            let apart = |b: &[f64; 4]| a[0] >= b[1] || b[0] >= a[1] || a[2] >= b[3] || b[2] >= a[3];
            assert!(boxes[..i].iter().all(apart), "{boxes:?}");
        }
    }
}

#[test]
fn a_limit_without_a_line_is_told_in_words() {
    let mut own = map();
    (own.limits[0].at, own.limits[0].kept) = (100.0, Side::Below);
    assert!(own.svg().contains("a remark; ξmax = 1: kept everywhere"));
    own.limits[0].kept = Side::Above;
    let svg = own.svg();
    assert!(svg.contains("ξmax = 1: kept nowhere") && svg.contains("class=\"beyond\""));
}

#[test]
fn the_limit_is_a_line_with_its_text() {
    let svg = map().svg();
    assert_well_formed(&svg);
    assert!(!tags(&svg, "limits", "polyline").is_empty());
    assert!(svg.contains("ξmax = 1") && svg.contains("stiffness (MN/m)"));
    assert!(svg.contains("peak force (kN)") && svg.contains("a remark"));
}

#[test]
fn gaps_are_left_blank_beside_blocks_and_nothing_at_all_is_drawn_too() {
    let mut own = map();
    own.values[3] = f64::NAN;
    let svg = own.svg();
    assert_well_formed(&svg);
    // Two squares of three known corners each.
    assert_eq!(tags(&svg, "blocks", "rect").len(), 6);
    assert_well_formed(&Map::default().svg());
    let flat = Map { values: vec![2.0; 24], ..map() };
    assert_well_formed(&flat.svg());
    for (x, y) in [(vec![1.0], vec![1.0, 2.0]), (vec![1.0, 2.0], vec![1.0])] {
        let values = vec![1.0, 2.0];
        assert_well_formed(&Map { x, y, values, ..Map::default() }.svg());
    }
}

#[test]
fn values_far_from_the_others_are_told_at_the_bar() {
    let mut own = product();
    own.value_scale = Scale::Linear;
    own.values[0] = -5e5;
    let last = own.values.len() - 1;
    own.values[last] = 7e6;
    let svg = own.svg();
    assert_well_formed(&svg);
    assert_eq!(tags(&svg, "bar", "polygon").len(), 2);
    assert!(svg.contains("to 7") && svg.contains("to −5"), "{svg}");
}

#[test]
fn lines_of_large_values_carry_their_power_of_ten() {
    let mut own = map();
    own.values.iter_mut().for_each(|value| *value *= 1e3);
    let svg = own.svg();
    let labels = svg.split("class=\"labels\"").nth(1).unwrap();
    assert!(labels.split("</g>").next().unwrap().contains("·10³"), "{svg}");
}

#[test]
fn texts_of_limits_stay_within_the_frame() {
    let mut own = map();
    // A line through the corner of the lowest places.
    let value = |at: usize| if at % 8 + at / 8 < 2 { 0.0 } else { 1.0 };
    own.limits[0].values = (0..24).map(value).collect();
    own.limits[0].at = 0.5;
    let svg = own.svg();
    let number = |text: &str, key: &str| -> f64 {
        let rest = text.split(&format!(" {key}=\"")).nth(1).unwrap();
        rest.split('"').next().unwrap().parse().unwrap()
    };
    let frame = svg.split("class=\"axes\"").nth(1).unwrap().split("<rect").nth(1).unwrap();
    let text = svg.split("class=\"limit-labels\"").nth(1).unwrap().split("<text").nth(1).unwrap();
    let half = 0.5 * 1.12 * text_width("ξmax = 1", theme::TICK_SIZE);
    let (left, bottom) = (number(frame, "x"), number(frame, "y") + number(frame, "height"));
    assert!(number(text, "x") - half > left + 2.0, "{text}");
    assert!(number(text, "y") + 4.0 < bottom, "{text}");
}
