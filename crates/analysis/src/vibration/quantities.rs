//! The quantities that curves over frequency show: of nodes, elements and supports, and of what is driven.

use dashpot_network::{ConnectionOutputs, DriveOutputs, Source};

use super::{
    DriveKind, Vibration, VibrationError,
    observed::{Form, Observed, Response, supports},
};

/// A quantity whose amplitude is looked at over frequency, for one unit of the drive.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// Its word behind a name, as in `padding.force`.
    pub word: &'static str,
    /// What it is, with `{}` for the amplitude of the drive.
    pub about: &'static str,
    /// SI unit where a motion drives, and where a load does.
    units: [&'static str; 2],
    /// What may have it.
    of: &'static str,
    /// All responses of this quantity in a network.
    all: fn(&Vibration) -> Vec<Response>,
}

/// All quantities; the first is that of a name alone where a motion drives, the second where a load does.
/// **A new one is registered here.**
pub const QUANTITIES: [Quantity; 7] = [
    Quantity {
        word: "displacement",
        about: "displacement of a node over {}",
        units: ["1", "m/N"],
        of: "node that can move",
        all: Vibration::displacements,
    },
    Quantity {
        word: "force",
        about: "force on a support or of an element over {}",
        units: ["N/m", "1"],
        of: "support or element",
        all: Vibration::forces,
    },
    Quantity {
        word: "deformation",
        about: "deformation of an element over {}",
        units: ["1", "m/N"],
        of: "element",
        all: |own| own.of_elements(|at| Some(vec![Observed::deformation(&own.assembly, at)])),
    },
    Quantity {
        word: "power",
        about: "mean power that the dashpots of an element dissipate, over the square of {}",
        units: ["W/m^2", "W/N^2"],
        of: "element with a dashpot",
        all: Vibration::powers,
    },
    of_drive(
        "dynamic-stiffness",
        "force of the drive over the displacement of its node",
        "N/m",
        |own| own.driving_point(0),
    ),
    of_drive("impedance", "force of the drive over the velocity of its node", "N s/m", |own| {
        own.driving_point(1)
    }),
    of_drive(
        "apparent-mass",
        "force of the drive over the acceleration of its node",
        "kg",
        |own| own.driving_point(2),
    ),
];

const fn of_drive(
    word: &'static str,
    about: &'static str,
    unit: &'static str,
    all: fn(&Vibration) -> Vec<Response>,
) -> Quantity {
    Quantity { word, about, units: [unit; 2], of: "node that the drive moves", all }
}

/// What is looked at: a quantity of a node, element or support.
pub(super) struct Receiver {
    /// As it is asked for.
    pub(super) name: String,
    pub(super) quantity: &'static Quantity,
    pub(super) response: Response,
}

impl Quantity {
    /// SI unit of its ratio to the drive.
    pub fn unit(&self, drive: DriveKind) -> &'static str {
        self.units[drive.place()]
    }
}

impl Vibration {
    /// The quantity of each response to what `of` names: of masses or supports where nothing is named.
    ///
    /// # Errors
    ///
    /// [`VibrationError`] where what is named is not there, and where nothing is to be seen.
    pub fn quantities(&self, of: &[String]) -> Result<Vec<&'static Quantity>, VibrationError> {
        Ok(self.receivers(of)?.iter().map(|own| own.quantity).collect())
    }

    /// What is looked at: what `of` names, or all masses where a motion drives and all supports where a load does.
    pub(super) fn receivers(&self, of: &[String]) -> Result<Vec<Receiver>, VibrationError> {
        if !of.is_empty() {
            return of.iter().map(|name| self.receiver(name)).collect();
        }
        let (all, sought) = match self.drive.kind {
            DriveKind::Motion => {
                (self.masses().into_iter().map(Response::from).collect(), "mass that can move")
            }
            DriveKind::Load => (self.support_forces(), "support"),
        };
        if all.is_empty() {
            return Err(VibrationError::NothingToSee { sought });
        }
        let usual = |response: Response| Receiver {
            name: response.name.clone(),
            quantity: self.drive.kind.usual(),
            response,
        };
        Ok(all.into_iter().map(usual).collect())
    }

    /// What a name stands for, with the word of a quantity behind it or alone.
    fn receiver(&self, name: &str) -> Result<Receiver, VibrationError> {
        let alone = (name, self.drive.kind.usual());
        let worded = name.rsplit_once('.').and_then(|(owner, word)| {
            Some((owner, QUANTITIES.iter().find(|quantity| quantity.word == word)?))
        });
        let (owner, quantity) = worded.unwrap_or(alone);
        let find = |(owner, quantity): (&str, &'static Quantity)| {
            let response = (quantity.all)(self).into_iter().find(|own| own.name == owner)?;
            Some(Receiver { name: name.to_owned(), quantity, response })
        };
        // There may be a dot in the name of a node.
        let found = find(alone).or_else(|| find((owner, quantity)));
        found.ok_or_else(|| self.unknown(owner, quantity))
    }

    /// Why there is no such `quantity` of `owner`: what has one, or which ones there are of what stands before a word that
    /// is none.
    fn unknown(&self, owner: &str, quantity: &Quantity) -> VibrationError {
        let named = |all: fn(&Self) -> Vec<Response>| all(self).into_iter().map(|own| own.name);
        let of = |part: &str| -> Vec<String> {
            let has = |own: &&Quantity| named(own.all).any(|name| name == part);
            QUANTITIES.iter().filter(has).map(|own| format!("{part}.{}", own.word)).collect()
        };
        let before = owner.rsplit_once('.').map(|own| of(own.0)).unwrap_or_default();
        let (sought, known) =
            match (quantity.word == self.drive.kind.usual().word, before.is_empty()) {
                (true, false) => ("quantity", before),
                (true, true) => (quantity.of, of(owner)),
                _ => (quantity.of, Vec::new()),
            };
        let known = if known.is_empty() { named(quantity.all).collect() } else { known };
        VibrationError::UnknownNode { name: owner.to_owned(), sought, known }
    }

    fn displacements(&self) -> Vec<Response> {
        let free = self.ids().filter(|id| !self.is_held(id.index()));
        free.map(|id| Observed::motion(&self.assembly, id, 0).into()).collect()
    }

    fn support_forces(&self) -> Vec<Response> {
        let held = supports(&self.assembly).into_iter();
        held.map(|own| Observed::support(&self.assembly, own.0, &own.1).into()).collect()
    }

    fn forces(&self) -> Vec<Response> {
        let mut all = self.support_forces();
        all.extend(self.of_elements(|at| Some(vec![Observed::force(&self.assembly, at)?])));
        all
    }

    fn powers(&self) -> Vec<Response> {
        let mut all = self.of_elements(|at| {
            let dashpots = Observed::dashpots(&self.assembly, at);
            (!dashpots.is_empty()).then_some(dashpots)
        });
        all.iter_mut().for_each(|own| own.form = Form::Power);
        all
    }

    fn of_elements(&self, parts: impl Fn(usize) -> Option<Vec<Observed>>) -> Vec<Response> {
        let response = |(at, own): (usize, &ConnectionOutputs)| {
            Some(Response { name: own.name.clone(), form: Form::Value, parts: parts(at)? })
        };
        self.assembly.connections.iter().enumerate().filter_map(response).collect()
    }

    /// The force of the drive over the displacement of its node or, by `order`, over a derivative of that; for each name
    /// of the node.
    fn driving_point(&self, order: i32) -> Vec<Response> {
        let (form, part) = match self.drive.kind {
            DriveKind::Load => {
                (Form::Inverse, Some(Observed::motion(&self.assembly, self.node, order)))
            }
            DriveKind::Motion => (Form::Value, self.moving_force(order)),
        };
        let nodes = &self.assembly.nodes;
        let body = nodes[self.node.index()].body;
        let names = nodes.iter().filter(|own| own.body == body).map(|own| own.name.clone());
        let response = |name: String| Some(Response { name, form, parts: vec![part.clone()?] });
        names.filter_map(response).collect()
    }

    /// The force that moves the driven node \[N\], over `(iω)^order`.
    fn moving_force(&self, order: i32) -> Option<Observed> {
        let force = Observed::output("", self.driving()?.force, order);
        let Self { assembly, .. } = self;
        let has_layers = assembly.connections.iter().any(|own| own.has_layers);
        if has_layers || supports(assembly).len() > 1 {
            return Some(force);
        }
        // Where nothing else holds the masses, it accelerates all of them: a sum that is known at slow oscillation.
        let inertia = assembly.nodes.iter().map(|own| (own.position, own.mass)).collect();
        Some(force.or_sum(inertia, order - 2))
    }

    /// The outputs of the drive.
    pub(super) fn driving(&self) -> Option<&DriveOutputs> {
        let Self { assembly, drive, node, .. } = self;
        let body = assembly.nodes[node.index()].body;
        let source = match drive.kind {
            DriveKind::Load => Source::Load,
            DriveKind::Motion => Source::Motion,
        };
        let is_own =
            |own: &&DriveOutputs| own.source == source && assembly.nodes[own.node].body == body;
        assembly.drives.iter().find(is_own)
    }
}

impl DriveKind {
    /// The quantity that a name alone stands for: that of transmissibility.
    pub fn usual(self) -> &'static Quantity {
        &QUANTITIES[self.place()]
    }

    fn place(self) -> usize {
        usize::from(self == Self::Load)
    }
}
