//! Many scenes that share their blocks or their contacts: what they share is computed once.
//!
//! Blocks depend on shapes and densities, contacts on shapes alone (and the contact tolerances);
//! joints, loads and gravity change neither; the machine of one degree of freedom depends on all of
//! them and not on the ground that shakes it. The caller says which scenes are alike by [`Keys`];
//! what is made with reuse is the same bit by bit as what is made without.

use super::follow::machine::{Built, MachineOptions};
use base::error::InputError;
use model::{
    assembly::{self, Blocks},
    interface::{self, Interfaces, Model},
};
use scene::Scene;
use std::{
    collections::{HashMap, VecDeque},
    hash::Hash,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
};

/// What two scenes must have in common to share a part.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Keys {
    /// Everything that shapes and contacts depend on.
    pub shapes: Vec<u64>,
    /// Everything else that masses depend on.
    pub masses: Vec<u64>,
    /// Everything else in the scene.
    pub others: Vec<u64>,
}

/// So many blocks lists and contact lists are kept. More: memory. Fewer: threads that work on
/// different parts of a grid push each other's out.
const KEPT: usize = 64;

/// A scene, and what its machine is asked for: numbers, bit by bit, and the block.
type MachineKey = (Keys, Vec<Option<u64>>, Option<String>);

/// The parts that are kept.
#[derive(Default)]
pub struct Reuse {
    blocks: Store<[Vec<u64>; 2], Blocks>,
    contacts: Store<Vec<u64>, Interfaces>,
    machines: Store<MachineKey, Built>,
}

impl Reuse {
    /// The model of a scene, from what is known of scenes with the same keys; given up as soon as
    /// `is_over`.
    ///
    /// # Errors
    /// As [`prepare_until`](model::interface::prepare_until).
    pub fn prepare(
        &self,
        scene: &Scene,
        keys: &Keys,
        is_over: &dyn Fn() -> bool,
    ) -> Result<Model, InputError> {
        let key = [keys.shapes.clone(), keys.masses.clone()];
        let blocks = self.blocks.get(&key, || assembly::resolve_blocks(scene))?;
        let assembly = assembly::resolve_with(scene, (*blocks).clone())?;
        let find = || interface::detect_until(&assembly, is_over);
        let contacts = self.contacts.get(&keys.shapes, find)?;
        let interfaces = contacts.with_joints_of(&assembly)?;
        Ok(Model::detected(assembly, interfaces))
    }

    /// The machine of a scene, from what is known of scenes with the same keys; `make` makes it.
    ///
    /// # Errors
    /// As `make`.
    pub(super) fn machine(
        &self,
        keys: &Keys,
        options: &MachineOptions,
        make: impl FnOnce() -> Result<Built, InputError>,
    ) -> Result<Arc<Built>, InputError> {
        let MachineOptions { toward, control, restitution } = options;
        let point = control.as_ref().and_then(|(_, point)| *point);
        let numbers = toward.iter().map(|v| Some(v.to_bits()));
        let rest = [0, 1, 2].map(|k| point.map(|p| p[k].to_bits()));
        let numbers = numbers.chain(rest).chain([restitution.map(f64::to_bits)]).collect();
        let block = control.as_ref().map(|(block, _)| block.clone());
        self.machines.get(&(keys.clone(), numbers, block), make)
    }

    /// How often blocks were resolved, contacts detected and machines made.
    pub fn computed(&self) -> [usize; 3] {
        [
            self.blocks.computed.load(Ordering::Relaxed),
            self.contacts.computed.load(Ordering::Relaxed),
            self.machines.computed.load(Ordering::Relaxed),
        ]
    }
}

type Slot<V> = Arc<Mutex<Option<Arc<V>>>>;

/// Slots by key, and the keys by age.
type Slots<K, V> = (HashMap<K, Slot<V>>, VecDeque<K>);

/// A small store: the oldest entry makes room for the newest.
struct Store<K, V> {
    slots: Mutex<Slots<K, V>>,
    computed: AtomicUsize,
}

impl<K, V> Default for Store<K, V> {
    fn default() -> Self {
        Self { slots: Mutex::new((HashMap::new(), VecDeque::new())), computed: AtomicUsize::new(0) }
    }
}

impl<K: Clone + Eq + Hash, V> Store<K, V> {
    /// The value for `key`; computed under the lock of its own slot, so that threads with the same
    /// key wait instead of repeating the work. A failure is not kept: it may be due to something
    /// else in the scene.
    fn get(
        &self,
        key: &K,
        compute: impl FnOnce() -> Result<V, InputError>,
    ) -> Result<Arc<V>, InputError> {
        let slot = self.slot(key);
        let mut value = slot.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = &*value {
            return Ok(known.clone());
        }
        self.computed.fetch_add(1, Ordering::Relaxed);
        let new = Arc::new(compute()?);
        *value = Some(new.clone());
        Ok(new)
    }

    fn slot(&self, key: &K) -> Slot<V> {
        let mut slots = self.slots.lock().unwrap_or_else(PoisonError::into_inner);
        let (map, order) = &mut *slots;
        if let Some(slot) = map.get(key) {
            return slot.clone();
        }
        if order.len() >= KEPT
            && let Some(oldest) = order.pop_front()
        {
            map.remove(&oldest);
        }
        order.push_back(key.clone());
        map.entry(key.clone()).or_default().clone()
    }
}
