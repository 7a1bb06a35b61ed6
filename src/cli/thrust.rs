//! `voussoir thrust`

use super::{
    args::Thrust,
    exit::Exit,
    question::{Question, verdict},
    terminal::Terminal,
};
use voussoir::{
    analysis::{
        Model, Outcome,
        thrust::{answer, first_support, level, outwards},
    },
    error::{InputError, JsonPath},
    report::ResultFile,
    verdict::thrust::ThrustAt,
};

pub fn run(args: &Thrust, terminal: &Terminal) -> anyhow::Result<Exit> {
    let question = Question::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let at = place(args, &question.model).map_err(|e| question.refuse(e))?;
    let thrust = answer(&question.model, at, &question.control());
    let file = question.answer(terminal, &args.options(), || ResultFile::thrust(&question.scene, &question.model, &thrust))?;
    let Some(found) = &file.answer.thrust else { return Ok(verdict(file.answer.verdict)) };
    let open = [found.least.status, found.greatest.status].contains(&Outcome::Undecided);
    Ok(if open { Exit::Undecided } else { Exit::Yes })
}

/// The support and the direction that are asked about.
fn place(args: &Thrust, model: &Model) -> Result<ThrustAt, InputError> {
    let error = |text: String| InputError::at(JsonPath::root(), text);
    let blocks = &model.assembly.blocks;
    let supports = || blocks.iter().filter(|b| b.support).map(|b| b.id.as_str()).take(8).collect::<Vec<_>>().join(", ");
    let support = match &args.support {
        Some(id) => match model.assembly.find(id) {
            Some(index) if blocks[index].support => index,
            Some(_) => return Err(error(format!("--support {id}: this block is free")).hint(format!("supports are {}", supports()))),
            None => return Err(error(format!("--support {id}: there is no such block")).hint(format!("supports are {}", supports()))),
        },
        None => first_support(model).ok_or_else(|| error("no support touches a free block: there is no thrust".into()))?,
    };
    let id = &blocks[support].id;
    if !model.interfaces.list.iter().any(|f| f.a == support || f.b == support) {
        return Err(
            error(format!("support {id} touches no free block: there is no thrust on it")).hint("`voussoir check` lists near misses")
        );
    }
    let direction = match args.direction {
        Some(d) => level(&model.assembly.gravity, d.into(), nalgebra::Vector3::from(d).norm())
            .ok_or_else(|| error(format!("--direction {d:?} is parallel to gravity")).hint("give one across gravity, such as 1,0"))?,
        None => outwards(model, support).ok_or_else(|| {
            error(format!("support {id} lies straight below the blocks: no direction is outwards")).hint("give --direction X,Y")
        })?,
    };
    Ok(ThrustAt { support, direction: direction.into() })
}
