//! A platen that falls onto a cushion, as a scene has it.

use dashpot_analysis::sweep::ScenePoint;
use dashpot_network::{
    Network, NodeId, Start,
    effects::{Gravity, GravityStart, Separation},
};
use dashpot_units::STANDARD_GRAVITY;

use super::NoCushion;

/// A scene with the cushion at a thickness \[m\], or why there is none.
pub type PoseOfThickness<'p> = dyn Fn(f64) -> Result<ScenePoint, String> + Sync + 'p;

/// What falls onto what.
#[derive(Debug, Clone, PartialEq)]
pub struct Platen {
    /// The body that falls.
    pub body: String,
    /// The element that it falls on.
    pub pad: String,
    /// Whether the scene has other elements.
    pub has_others: bool,
    /// The area of that \[m²\].
    pub area: f64,
    /// Its thickness in the scene \[m\].
    pub thickness: f64,
    /// The mass of the body in the scene \[kg\].
    pub mass: f64,
    /// From what height it falls there \[m\]; of a speed, that from which it comes.
    pub height: Option<f64>,
    /// Gravity \[m/s²\], positive.
    pub gravity: f64,
    /// What a test has that the scene does not say.
    pub assumed: Vec<Assumed>,
}

/// Something that every drop test has, although the scene does not say so.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Assumed {
    /// Standard gravity.
    Gravity,
    /// The platen may leave the cushion.
    Separation,
}

impl Platen {
    /// Reads them from a network, with the names of the body and the element where it has several.
    ///
    /// # Errors
    ///
    /// What is no drop onto a cushion.
    pub fn of(network: &Network, body: Option<&str>, pad: Option<&str>) -> Result<Self, NoCushion> {
        let id = falling(network, body)?;
        let node = network.node(id);
        let at = pad_under(network, id, pad)?;
        let connection = &network.connections()[at];
        let gravity = network.effects().iter().find_map(|effect| effect.gravity());
        let own = gravity.unwrap_or(STANDARD_GRAVITY);
        if own <= 0.0 || own.is_nan() {
            return Err(NoCushion::NoWeight { gravity: own });
        }
        let height = height(node.start, own);
        let is_this = |own: &Separation| own.element == connection.name;
        let mut separations =
            network.effects().iter().filter_map(|own| own.of_kind::<Separation>());
        let end = usize::from(connection.between[1] == id);
        let parts = separations.any(is_this) || connection.never_pulls(end);
        let assumed = [
            gravity.is_none().then_some(Assumed::Gravity),
            (!parts).then_some(Assumed::Separation),
        ];
        let no_area = || NoCushion::NoArea { pad: connection.name.clone() };
        Ok(Self {
            body: node.name.clone(),
            pad: connection.name.clone(),
            has_others: network.connections().len() > 1,
            area: connection.area.ok_or_else(no_area)?,
            thickness: connection.thickness.unwrap_or(f64::NAN),
            mass: node.mass,
            height: height.filter(|own| *own > 0.0),
            gravity: own,
            assumed: assumed.into_iter().flatten().collect(),
        })
    }

    /// The static stress \[Pa\] of the mass in the scene.
    pub fn stress(&self) -> f64 {
        self.mass * self.gravity / self.area
    }

    /// By which factors the mass and the height of a scene with scatter differ from those here.
    pub(super) fn factors(&self, scattered: &Network) -> Option<[f64; 2]> {
        let node = scattered.node(scattered.node_named(&self.body)?);
        let height = height(node.start, self.gravity).zip(self.height);
        Some([node.mass / self.mass, height.map_or(1.0, |(own, mean)| own / mean)])
    }

    /// The speed \[m/s\] at touch after a fall from a height \[m\].
    pub fn speed(&self, height: f64) -> f64 {
        (2.0 * self.gravity * height).sqrt()
    }

    /// Lets the platen touch with the speed of a height \[m\] and the mass of a static stress \[Pa\].
    pub(super) fn drop_in(
        &self,
        network: &mut Network,
        height: f64,
        stress: f64,
    ) -> Result<(), String> {
        let missing = || format!("there is no `{}` at every thickness", self.body);
        let id = network.node_named(&self.body).ok_or_else(missing)?;
        network.node_mut(id).mass = stress * self.area / self.gravity;
        network.node_mut(id).start = Start::Velocity(self.speed(height));
        for own in &self.assumed {
            match own {
                Assumed::Gravity => network.add_effect(Gravity {
                    acceleration: self.gravity,
                    start: GravityStart::Equilibrium,
                }),
                Assumed::Separation => network.add_effect(Separation {
                    element: self.pad.clone(),
                    at: Some(self.body.clone()),
                    restitution: 0.0,
                }),
            }
        }
        Ok(())
    }
}

/// From what height \[m\] a body comes that starts like this.
fn height(start: Start, gravity: f64) -> Option<f64> {
    match start {
        Start::Drop(height) => Some(height),
        Start::Velocity(speed) => Some(0.5 * speed * speed / gravity),
        Start::Rest => None,
    }
}

/// The one body that falls.
fn falling(network: &Network, name: Option<&str>) -> Result<NodeId, NoCushion> {
    let masses = || network.nodes().filter(|own| own.1.mass > 0.0);
    let names = |all: Vec<&str>| all.into_iter().map(str::to_owned).collect::<Vec<_>>();
    let moving: Vec<_> = masses().filter(|own| own.1.is_impactor()).collect();
    let not_one =
        || NoCushion::NotOneBody { names: names(moving.iter().map(|own| &*own.1.name).collect()) };
    match (name, &moving[..]) {
        (None, [(id, _)]) => Ok(*id),
        (Some(name), [] | [_]) => {
            let found = masses().find(|own| own.1.name == name).map(|own| own.0);
            let known = names(masses().map(|own| &*own.1.name).collect());
            let unknown = NoCushion::Unknown { what: "mass", name: name.to_owned(), known };
            let found = found.ok_or(unknown)?;
            if moving.iter().any(|own| own.0 != found) { Err(not_one()) } else { Ok(found) }
        }
        _ => Err(not_one()),
    }
}

/// The position of the one pad under a body, which rests on nothing else.
fn pad_under(network: &Network, body: NodeId, name: Option<&str>) -> Result<usize, NoCushion> {
    let all = network.connections().iter().enumerate();
    let touching: Vec<_> = all.filter(|own| own.1.between.contains(&body)).collect();
    let pads: Vec<_> = touching.iter().filter(|own| own.1.thickness.is_some()).collect();
    let names = || pads.iter().map(|own| own.1.name.clone()).collect::<Vec<_>>();
    let owner = || network.node(body).name.clone();
    let found = match (name, &pads[..]) {
        (None, [only]) => only.0,
        (None, _) => return Err(NoCushion::NotOnePad { body: owner(), names: names() }),
        (Some(name), _) => {
            let own = pads.iter().find(|own| own.1.name == name).map(|own| own.0);
            let unknown =
                || NoCushion::Unknown { what: "pad", name: name.to_owned(), known: names() };
            own.ok_or_else(unknown)?
        }
    };
    match touching.iter().find(|own| own.0 != found) {
        Some((_, other)) => Err(NoCushion::Hangs { body: owner(), element: other.name.clone() }),
        None => Ok(found),
    }
}
