//! Many scenes that share their blocks or their contacts: what they share is computed once.
//!
//! Blocks depend on shapes and densities, contacts on shapes alone (and the contact tolerances);
//! joints, loads and gravity change neither. The caller says which scenes are alike by two
//! [`Keys`]; a model made with reuse is the same bit by bit as one made without.

use crate::{
    assembly::{self, Blocks},
    error::InputError,
    interface::{self, Interfaces, Model},
    scene::Scene,
};
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
}

/// So many blocks lists and contact lists are kept. More: memory. Fewer: threads that work on
/// different parts of a grid push each other's out.
const KEPT: usize = 64;

/// The parts that are kept.
#[derive(Default)]
pub struct Reuse {
    blocks: Store<Keys, Blocks>,
    contacts: Store<Vec<u64>, Interfaces>,
}

impl Reuse {
    /// The model of a scene, from what is known of scenes with the same keys; given up as soon as
    /// `is_over`.
    ///
    /// # Errors
    /// As [`prepare_until`](crate::interface::prepare_until).
    pub fn prepare(
        &self,
        scene: &Scene,
        keys: &Keys,
        is_over: &dyn Fn() -> bool,
    ) -> Result<Model, InputError> {
        let blocks = self.blocks.get(keys, || assembly::resolve_blocks(scene))?;
        let assembly = assembly::resolve_with(scene, (*blocks).clone())?;
        let find = || interface::detect_until(&assembly, is_over);
        let contacts = self.contacts.get(&keys.shapes, find)?;
        let interfaces = contacts.with_joints_of(&assembly)?;
        Ok(Model::detected(assembly, interfaces))
    }

    /// How often blocks were resolved and contacts detected.
    pub fn computed(&self) -> [usize; 2] {
        [
            self.blocks.computed.load(Ordering::Relaxed),
            self.contacts.computed.load(Ordering::Relaxed),
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
