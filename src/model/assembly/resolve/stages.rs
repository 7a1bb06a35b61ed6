//! Stage specs → [`Stage`]s: patterns matched, every change checked against what stands before it.
//!
//! What some stage adds is not there before it is first added; all else is there from the start.
//! Changes of one stage happen in the order add, hold, release, remove.

use super::Names;
use crate::assembly::{AskedStages, Assembly, MemberPlan, Stage};
use base::error::{InputError, JsonPath};
use scene::{Scene, StageSpec, fits, suggest};
use std::collections::BTreeSet;

/// What names can stand for.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Thing {
    Block(usize),
    Member(String),
    Load(String),
}

/// The names of a scene.
struct Known<'a> {
    assembly: &'a Assembly,
    members: Vec<String>,
    loads: Vec<String>,
}

/// The stages of a scene, in order; none where it has none. `assembly` is that of the whole scene.
///
/// # Errors
/// A stage changes nothing, names what there is not, adds what is there, removes what is not, holds
/// what cannot be held, or leaves nothing that could move.
pub fn stages(scene: &Scene, assembly: &Assembly) -> Result<Vec<Stage>, InputError> {
    let root = JsonPath::root();
    let known = Known::new(scene, assembly)?;
    let mut now = Stage::whole(assembly.blocks.len());
    let mut all = Vec::new();
    let specs: Vec<(&StageSpec, JsonPath)> = (scene.stages.iter().enumerate())
        .map(|(k, spec)| (spec, root.key("stages").index(k)))
        .collect();
    let mut told = BTreeSet::new();
    for (spec, path) in &specs {
        let lists = [
            ("add", &spec.add),
            ("add_one_by_one", &spec.add_one_by_one),
            ("remove", &spec.remove),
            ("remove_one_by_one", &spec.remove_one_by_one),
        ];
        for (key, list) in lists {
            for (thing, _) in known.things(list, &path.key(key))? {
                // What is removed before it is added stands at the start.
                if told.insert(thing.clone()) && key.starts_with("add") {
                    put(&mut now, &thing, false);
                }
            }
        }
    }
    for (spec, path) in &specs {
        for (name, change) in known.split(spec, path)? {
            known.apply(&mut now, &change)?;
            now.name = match (spec.name.is_empty(), name) {
                (true, None) => format!("stage {}", all.len() + 1),
                (true, Some(name)) => name,
                (false, None) => spec.name.clone(),
                (false, Some(name)) => format!("{}: {name}", spec.name),
            };
            now.path = path.clone();
            let moves = |i: usize| now.present[i] && !now.held[i] && !assembly.blocks[i].support;
            if !(0..assembly.blocks.len()).any(moves) {
                return Err(InputError::at(
                    path.clone(),
                    "no free block stands at this stage: there is nothing to decide",
                )
                .hint("merge it with the next stage, or leave a block free"));
            }
            all.push(now.clone());
        }
    }
    let mut names = BTreeSet::new();
    if let Some(twice) = all.iter().find(|s| !names.insert(s.name.as_str())) {
        let text = format!("two stages are called {:?}", twice.name);
        return Err(InputError::at(twice.path.key("name"), text)
            .hint("every stage needs a name of its own"));
    }
    Ok(all)
}

/// The stages that are asked about.
///
/// # Errors
/// As [`stages`], and where there are none; a block is placed that cannot be.
pub fn asked_stages(
    asked: AskedStages,
    scene: &Scene,
    assembly: &Assembly,
) -> Result<Vec<Stage>, InputError> {
    match asked {
        AskedStages::InOrder(placed) => Stage::in_order(assembly, placed),
        AskedStages::OfScene => {
            let all = stages(scene, assembly)?;
            if all.is_empty() {
                return Err(InputError::at(JsonPath::root(), "the scene has no stages").hint(
                    "add \"stages\": [{ \"add_one_by_one\": [\"*\"] }] to it, or ask with --any-order, or `voussoir without`",
                ));
            }
            Ok(all)
        }
    }
}

/// The free blocks of a scene in the order in which names and patterns (`*` for any letters) give
/// them; all of one pattern in the order of the scene.
///
/// # Errors
/// A name fits no free block, or names one twice; a free block is not named.
pub fn named_blocks(
    names: &[String],
    scene: &Scene,
    assembly: &Assembly,
    path: &JsonPath,
) -> Result<Vec<usize>, InputError> {
    let known = Known::new(scene, assembly)?;
    let things = known.blocks(names, path)?;
    let mut list = Vec::new();
    for (thing, path) in things {
        let Thing::Block(i) = thing else { continue };
        if !assembly.blocks[i].support {
            list.push(i);
        } else if names.iter().any(|n| *n == assembly.blocks[i].id) {
            let text = format!("{:?} is a support: it stands from the start", known.name(&thing));
            return Err(InputError::at(path, text).hint("leave it out of the order"));
        }
    }
    if let Some(missing) = assembly.free().find(|i| !list.contains(i)) {
        let text = format!("{:?} is not in the order", assembly.blocks[missing].id);
        return Err(InputError::at(path.clone(), text).hint("name every free block once"));
    }
    Ok(list)
}

/// One stage of those that a spec stands for: what tells it from the others, and what it changes.
type Split = (Option<String>, Vec<Change>);

/// One change with its lists.
struct Change {
    key: &'static str,
    things: Vec<(Thing, JsonPath)>,
}

fn put(stage: &mut Stage, thing: &Thing, there: bool) {
    let list = match thing {
        Thing::Block(i) => return stage.present[*i] = there,
        Thing::Member(_) => &mut stage.without_members,
        Thing::Load(_) => &mut stage.without_loads,
    };
    let (Thing::Member(name) | Thing::Load(name)) = thing else { return };
    list.retain(|n| n != name);
    if !there {
        list.push(name.clone());
    }
}

fn is_there(stage: &Stage, thing: &Thing) -> bool {
    match thing {
        Thing::Block(i) => stage.present[*i],
        Thing::Member(name) => !stage.without_members.contains(name),
        Thing::Load(name) => !stage.without_loads.contains(name),
    }
}

impl<'a> Known<'a> {
    fn new(scene: &Scene, assembly: &'a Assembly) -> Result<Self, InputError> {
        let members = assembly.members.iter().map(|plan| match plan {
            MemberPlan::Whole(m) => m.id.split('/').next().unwrap_or(&m.id).to_string(),
            MemberPlan::Strip(s) => s.id.clone(),
            MemberPlan::Dowel(d) => d.id.clone(),
        });
        let mut members: Vec<String> = members.collect();
        members.dedup();
        let (mut loads, mut seen) = (Vec::new(), BTreeSet::new());
        for (key, list) in [("dead", &scene.loads.dead), ("live", &scene.loads.live)] {
            for (i, load) in list.iter().enumerate() {
                let Some(id) = &load.id else { continue };
                let path = JsonPath::root().key("loads").key(key).index(i).key("id");
                if id.trim().is_empty() {
                    return Err(InputError::at(path, "the id is empty")
                        .hint("give the load a name, or leave \"id\" out"));
                }
                if !seen.insert(id) {
                    let text = format!("the id {id:?} is already that of another load");
                    return Err(
                        InputError::at(path, text).hint("every load needs a name of its own")
                    );
                }
                loads.push(id.clone());
            }
        }
        Ok(Self { assembly, members, loads })
    }

    fn name(&self, thing: &Thing) -> String {
        match thing {
            Thing::Block(i) => self.assembly.blocks[*i].id.clone(),
            Thing::Member(name) | Thing::Load(name) => name.clone(),
        }
    }

    /// What a list of patterns stands for, in the order of the list and of the scene, each once.
    fn things(
        &self,
        list: &[String],
        path: &JsonPath,
    ) -> Result<Vec<(Thing, JsonPath)>, InputError> {
        let mut found: Vec<(Thing, JsonPath)> = Vec::new();
        for (k, pattern) in list.iter().enumerate() {
            let path = path.index(k);
            let blocks = self.assembly.blocks.iter().enumerate();
            let blocks = blocks.filter(|(_, b)| fits(pattern, &b.id)).map(|(i, _)| Thing::Block(i));
            let named = |list: &[String], make: fn(String) -> Thing| -> Vec<Thing> {
                list.iter().filter(|n| fits(pattern, n)).cloned().map(make).collect()
            };
            let mut here: Vec<Thing> = blocks.collect();
            here.extend(named(&self.members, Thing::Member));
            here.extend(named(&self.loads, Thing::Load));
            if here.is_empty() {
                let all = self.assembly.blocks.iter().map(|b| b.id.as_str());
                let all = all.chain(self.members.iter().chain(&self.loads).map(String::as_str));
                let text = format!("no block, member or load is called {pattern:?}");
                return Err(InputError {
                    hint: suggest(pattern, all),
                    ..InputError::at(path, text)
                });
            }
            if !pattern.contains('*') && here.len() > 1 {
                let text =
                    format!("{pattern:?} is the name of several: of a block, a member or a load");
                return Err(InputError::at(path, text).hint("give them names of their own"));
            }
            for thing in here {
                if found.iter().any(|(other, _)| *other == thing) {
                    let text = format!("{:?} is named twice", self.name(&thing));
                    return Err(InputError::at(path, text).hint("name it once"));
                }
                found.push((thing, path.clone()));
            }
        }
        Ok(found)
    }

    /// The same of blocks alone.
    fn blocks(
        &self,
        list: &[String],
        path: &JsonPath,
    ) -> Result<Vec<(Thing, JsonPath)>, InputError> {
        let things = self.things(list, path)?;
        match things.iter().find(|(thing, _)| !matches!(thing, Thing::Block(_))) {
            Some((thing, path)) => {
                let text = format!("{:?} is not a block", self.name(thing));
                Err(InputError::at(path.clone(), text).hint("only blocks can be named here"))
            }
            None => Ok(things),
        }
    }

    /// The stages that one spec stands for, each with what tells it from the others.
    fn split(&self, spec: &StageSpec, path: &JsonPath) -> Result<Vec<Split>, InputError> {
        let StageSpec { name: _, add, remove, hold, release, add_one_by_one, remove_one_by_one } =
            spec;
        let plain = [add, hold, release, remove].iter().any(|l| !l.is_empty());
        let single = [("add", add_one_by_one), ("remove", remove_one_by_one)];
        let singles = single.iter().filter(|(_, l)| !l.is_empty()).count();
        match (plain, singles) {
            (false, 0) => Err(InputError::at(path.clone(), "the stage changes nothing")
                .hint("give \"add\", \"remove\", \"hold\" or \"release\"")),
            (true, 0) => {
                let change = |key: &'static str, things| Change { key, things };
                Ok(vec![(
                    None,
                    vec![
                        change("add", self.things(add, &path.key("add"))?),
                        change("hold", self.blocks(hold, &path.key("hold"))?),
                        change("release", self.blocks(release, &path.key("release"))?),
                        change("remove", self.things(remove, &path.key("remove"))?),
                    ],
                )])
            }
            (false, 1) => {
                let [(key, list), ..] = match single {
                    [(_, l), other] if l.is_empty() => [other],
                    [one, _] => [one],
                };
                let path =
                    path.key(if key == "add" { "add_one_by_one" } else { "remove_one_by_one" });
                let mut things = self.blocks(list, &path)?;
                things.sort_by(|a, b| a.0.cmp(&b.0));
                let stage = |(thing, path): (Thing, JsonPath)| {
                    let name = format!("{key} {}", self.name(&thing));
                    (Some(name), vec![Change { key, things: vec![(thing, path)] }])
                };
                Ok(things.into_iter().map(stage).collect())
            }
            _ => Err(InputError::at(
                path.clone(),
                "\"add_one_by_one\" and \"remove_one_by_one\" make stages of their own and cannot be combined with other changes",
            )
            .hint("use a separate stage for each")),
        }
    }

    fn apply(&self, now: &mut Stage, changes: &[Change]) -> Result<(), InputError> {
        for Change { key, things } in changes {
            for (thing, path) in things {
                let name = self.name(thing);
                let refuse =
                    |text: String, hint: &str| Err(InputError::at(path.clone(), text).hint(hint));
                let there = is_there(now, thing);
                match (*key, thing) {
                    ("add", _) if there => {
                        return refuse(
                            format!("{name:?} is already in place"),
                            "add it once, or remove it before",
                        );
                    }
                    ("add", _) => put(now, thing, true),
                    (_, _) if !there => {
                        return refuse(
                            format!("{name:?} is not in place"),
                            "add it before, in this stage or another",
                        );
                    }
                    ("remove", _) => {
                        put(now, thing, false);
                        if let Thing::Block(i) = thing {
                            now.held[*i] = false;
                        }
                    }
                    ("hold", Thing::Block(i)) if self.assembly.blocks[*i].support => {
                        return refuse(
                            format!("{name:?} is a support: it is held anyway"),
                            "remove it from the list",
                        );
                    }
                    ("hold", Thing::Block(i)) if now.held[*i] => {
                        return refuse(format!("{name:?} is held already"), "hold it once");
                    }
                    ("release", Thing::Block(i)) if self.assembly.blocks[*i].support => {
                        return refuse(
                            format!("{name:?} is a support of the scene and cannot be released"),
                            "leave \"support\" out and hold the block in the first stage, or remove it",
                        );
                    }
                    ("release", Thing::Block(i)) if !now.held[*i] => {
                        return refuse(
                            format!("{name:?} is not held"),
                            "hold it in a stage before",
                        );
                    }
                    (key, Thing::Block(i)) => now.held[*i] = key == "hold",
                    (_, Thing::Member(_) | Thing::Load(_)) => {}
                }
            }
        }
        Ok(())
    }
}

/// The loads of a scene with some of them left out, on the blocks of `assembly`: the assembly with
/// these in place of its own.
///
/// # Errors
/// As [`resolve`](super::resolve()), for loads.
pub fn with_loads(
    scene: &Scene,
    assembly: &Assembly,
    without: &[String],
) -> Result<Assembly, InputError> {
    let mut scene = scene.clone();
    let stays = |load: &scene::Load| load.id.as_ref().is_none_or(|id| !without.contains(id));
    scene.loads.dead.retain(stays);
    scene.loads.live.retain(stays);
    let names = Names::new(&assembly.blocks)?;
    let loads = super::loads::resolve(&scene, assembly, &names)?;
    Ok(Assembly {
        dead: loads.dead,
        live: loads.live,
        dead_forces: loads.dead_forces,
        live_forces: loads.live_forces,
        ..assembly.clone()
    })
}
