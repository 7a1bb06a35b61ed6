//! How joints resist.

use super::Block;
use scene::{Friction, MaterialFactors};

/// The law of one joint. Stresses act on the area that touches; forces at the corners of an
/// interface count with the corner's share of the area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLaw {
    /// Friction μ on the effective normal force.
    pub friction: Friction,
    /// Cohesion, Pa: shear resistance without any pressure.
    pub cohesion: f64,
    /// Tensile strength, Pa. Beyond cohesion / μ it has no effect: shear fails first.
    pub tension: f64,
    /// Compressive strength, Pa; infinite where crushing is excluded.
    pub compression: f64,
    /// Pressure of the water in the joint, Pa: it pushes the blocks apart and takes its part off
    /// the normal force that friction and strength see.
    pub pore_pressure: f64,
    /// Rolling arm c, m: a point or an edge that touches carries couples `‖m_t‖ ≤ c f_n` (rolling)
    /// and `|m_n| ≤ c f_n` (twisting).
    pub rolling_arm: f64,
    /// Pressure by which the joint closes one metre, Pa/m, where it is known. The joint is rigid for
    /// every question but `state`.
    pub normal_stiffness: Option<f64>,
    /// The same for shear, Pa/m.
    pub shear_stiffness: Option<f64>,
}

impl JointLaw {
    /// Dry friction and nothing else.
    pub fn dry(friction: Friction) -> Self {
        Self {
            friction,
            cohesion: 0.0,
            tension: 0.0,
            compression: f64::INFINITY,
            pore_pressure: 0.0,
            rolling_arm: 0.0,
            normal_stiffness: None,
            shear_stiffness: None,
        }
    }

    /// Whether dry friction is all there is, however far it yields.
    pub fn is_dry(&self) -> bool {
        let rigid = Self { normal_stiffness: None, shear_stiffness: None, ..*self };
        rigid == Self::dry(self.friction)
    }

    /// Whether nothing in it is a stress: only friction and couples in proportion to the normal
    /// force.
    pub fn friction_only(&self) -> bool {
        Self { rolling_arm: 0.0, ..*self }.is_dry()
    }

    /// The same law with its strengths divided by partial factors. Pressures and arms are none.
    #[must_use]
    pub fn divided(&self, by: &MaterialFactors) -> Self {
        let friction = match self.friction {
            Friction::Coefficient(mu) => Friction::Coefficient(mu / by.friction.unwrap_or(1.0)),
            Friction::Infinite => Friction::Infinite,
        };
        Self {
            friction,
            cohesion: self.cohesion / by.cohesion.unwrap_or(1.0),
            tension: self.tension / by.tension.unwrap_or(1.0),
            compression: self.compression / by.compression.unwrap_or(1.0),
            ..*self
        }
    }

    /// The same law with every stress multiplied.
    pub fn with_stresses(&self, by: f64) -> Self {
        Self {
            cohesion: self.cohesion * by,
            tension: self.tension * by,
            compression: self.compression * by,
            pore_pressure: self.pore_pressure * by,
            ..*self
        }
    }
}

/// The law of the joint between any two blocks.
#[derive(Clone, Debug)]
pub struct JointRules {
    /// Rule for joints without an exception.
    pub default: Option<JointLaw>,
    /// Exceptions by material names, in file order.
    pub by_material: Vec<([String; 2], JointLaw)>,
    /// Exceptions by block indices, smaller index first.
    pub by_blocks: std::collections::HashMap<(usize, usize), JointLaw>,
}

impl JointRules {
    /// The law between two blocks: the rule for the two blocks, else the last rule for their
    /// materials, else the default. `None` where no rule says any.
    pub fn law(&self, a: usize, b: usize, blocks: &[Block]) -> Option<JointLaw> {
        if let Some(law) = self.by_blocks.get(&(a.min(b), a.max(b))) {
            return Some(*law);
        }
        let material = |i: usize| blocks.get(i).and_then(|b| b.material.as_ref());
        self.of_materials(material(a), material(b))
    }

    /// The law between two blocks of these materials that no rule names by themselves.
    pub fn of_materials(&self, one: Option<&String>, two: Option<&String>) -> Option<JointLaw> {
        let named = |[m, n]: &[String; 2]| {
            (one == Some(m) && two == Some(n)) || (one == Some(n) && two == Some(m))
        };
        self.by_material
            .iter()
            .rev()
            .find(|(pair, _)| named(pair))
            .map(|(_, law)| *law)
            .or(self.default)
    }
}
