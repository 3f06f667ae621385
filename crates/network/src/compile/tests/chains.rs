//! Chains of Kelvin–Voigt elements.

use dashpot_dae::{Piece, Run, Silent, Waveform, methods};

use super::{dashpot, spring};
use crate::{Model, Network, Node};

fn chain(kind: &str, n: i32, d: i32, even: bool, order: i32) -> Model {
    let mut parts = Vec::new();
    for i in 0..n {
        let k = if even { 1e6 * f64::from(1 + (7 * i) % 5) } else { 1e6 * format!("1e{}", (5 * i) % 4).parse::<f64>().unwrap() };
        let e = -d / 2 + d * i / (n - 1);
        let c = k * format!("1e{e}").parse::<f64>().unwrap() * f64::from(1 + i % 3);
        parts.push(Model::parallel([spring(k), dashpot(c)]));
    }
    match order {
        0 => {}
        1 => parts.reverse(),
        _ => { let m = parts.len(); parts = (0..m).map(|i| parts[(i * 5 + 2) % m].clone()).collect(); }
    }
    let mut all = Vec::new();
    if kind.contains('s') { all.push(spring(3e6)); }
    if kind.contains('h') { all.push(spring(3e9)); }
    if kind.contains('d') { all.push(dashpot(7e6)); }
    all.extend(parts);
    Model::series(all)
}

#[test]
fn experiment() {
    for (drive, kinds) in [("load", vec!["", "s", "sd", "hd"]), ("hold", vec!["s", "sd", "h"]), ("ramp", vec!["", "d"]), ("mass", vec!["", "s", "sd", "h", "d"])] {
        for kind in kinds { for n in [4, 8, 11] { for d in [6, 10, 12, 13] { for even in [true, false] { for order in 0..3 {
            let model = chain(kind, n, d, even, order);
            let mut network = Network::new();
            let end = 3.0 * 10f64.powi(d / 2);
            let (head, out) = match drive {
                "load" => { let h = network.add_node(Node::massless("head")); network.add_load("f", h, Waveform::constant(1e3)); (h, "head.position") }
                "hold" => (network.add_node(Node::prescribed("head", Waveform::constant(1e-3))), "pad.force"),
                "ramp" => (network.add_node(Node::prescribed("head", Waveform::new(vec![Piece { start: 0.0, value: 0.0, slope: 1e-3, ..Piece::default() }]).unwrap())), "pad.force"),
                _ => (network.add_node(Node::mass("head", 1e6).moving(1.0)), "head.position"),
            };
            network.connect("pad", head, network.ground(), model);
            let assembly = network.compile(end).unwrap();
            let name = format!("{drive}|{kind}|{n}|{d}|{}|{order}", i32::from(even));
            let at = assembly.output(out).unwrap();
            let exact = methods::by_name("exact").unwrap();
            let lo = -d / 2;
            match exact.integrate(&assembly.system, &Run::to(end), &mut Silent) {
                Ok(t) => { let s = t.signal(&assembly.system, at);
                    let v: Vec<String> = (lo..=d / 2).map(|e| format!("{:e}", s.value(format!("1e{e}").parse().unwrap()))).collect();
                    println!("EX {name} {:e} {}", s.error.unwrap_or(f64::NAN), v.join(" ")); }
                Err(e) => println!("FAIL {name} {e}"),
            }
            if std::env::var("BDF").is_ok() && order == 2 {
                let bdf = methods::by_name("bdf").unwrap();
                match bdf.integrate(&assembly.system, &Run::to(end).with_rtol(1e-7), &mut Silent) {
                    Ok(t) => { let s = t.signal(&assembly.system, at);
                        let v: Vec<String> = (lo..=d / 2).map(|e| format!("{:e}", s.value(format!("1e{e}").parse().unwrap()))).collect();
                        println!("BDF {name} {} {}", format!("{:?}", t.statistics).replace(' ', ""), v.join(" ")); }
                    Err(e) => println!("BFAIL {name} {e}"),
                }
            }
        }}}}}
    }
}
