//! Drawings, files for ParaView and tables of an answer.

use super::{args, output::Sink, terminal::say};
use anyhow::{Context, bail};
use std::{
    borrow::Cow,
    fs,
    io::ErrorKind,
    path::{Path, PathBuf},
};
use voussoir::report::{
    drawing::{self, Aspect},
    gltf,
    models::{self, Program},
    obj, table,
    view::View,
    vtk,
};

/// What is to be made of an answer, and where it goes.
#[derive(Debug, Default)]
pub struct Pictures {
    svg: Option<Sink>,
    aspect: Aspect,
    vtk: Option<Sink>,
    /// With whether it is the binary container.
    gltf: Option<(Sink, bool)>,
    obj: Option<Sink>,
    /// With the program that reads it.
    model: Option<(Sink, Program)>,
    /// Supports are left out.
    hides: bool,
    /// Drawings have dimensions.
    measures: bool,
    /// Where the files of single moments go.
    frames: Option<PathBuf>,
    /// Joints and blocks.
    csv: Option<[Sink; 2]>,
    /// Where the table of members goes, if the scene has any.
    members: Option<PathBuf>,
    printed: usize,
}

impl Pictures {
    /// Opens what will be written. `table` is where the table of joints goes; that of the blocks
    /// goes beside it.
    pub fn open(args: &args::Pictures, table: Option<&Path>) -> anyhow::Result<Self> {
        Self::open_as(args, table, "vtp")
    }

    /// As [`Self::open`], for what happens in time: a collection of VTK files, which stand in a
    /// folder of the same name.
    pub fn open_film(args: &args::Pictures) -> anyhow::Result<Self> {
        let mut pictures = Self::open_as(args, None, "pvd")?;
        if let Some(path) = &args.vtk {
            let folder = path.with_extension("");
            fs::create_dir_all(&folder)
                .with_context(|| format!("{}: cannot be written", folder.display()))?;
            pictures.frames = Some(folder);
        }
        Ok(pictures)
    }

    fn open_as(args: &args::Pictures, table: Option<&Path>, ending: &str) -> anyhow::Result<Self> {
        let fits = |p: &Path| {
            p.extension().is_some_and(|e| e == ending) || (is_dash(p) && ending == "vtp")
        };
        if let Some(path) = args.vtk.as_deref().filter(|p| !fits(p)) {
            let named = if is_dash(path) {
                PathBuf::from(format!("FILE.{ending}"))
            } else {
                path.with_extension(ending)
            };
            bail!(
                "--vtk {}: ParaView needs the ending .{ending} for this file; name it {}",
                path.display(),
                named.display()
            );
        }
        let open = |path: Option<&Path>| path.map(|p| Sink::open(Some(p))).transpose();
        let printed = [&args.svg, &args.vtk, &args.gltf, &args.obj, &args.model]
            .into_iter()
            .map(|p| p.as_deref())
            .chain([table])
            .flatten()
            .filter(|p| is_dash(p))
            .count();
        if printed > 1 {
            bail!(
                "only one of --svg, --vtk, --gltf, --obj, --model and --csv can go to standard output"
            );
        }
        let tables = match table {
            Some(path) if is_dash(path) => {
                bail!("--csv needs a file: the table of the blocks is written beside it")
            }
            Some(path) => {
                Some([Sink::open(Some(path))?, Sink::open(Some(&beside(path, "blocks")))?])
            }
            None => None,
        };
        let (svg, vtk) = (open(args.svg.as_deref())?, open(args.vtk.as_deref())?);
        let binary = |p: &Path| p.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb"));
        let gltf = args.gltf.as_deref().map(|p| anyhow::Ok((Sink::open(Some(p))?, binary(p))));
        Ok(Self {
            svg,
            aspect: args.view.unwrap_or_default(),
            vtk,
            gltf: gltf.transpose()?,
            obj: open(args.obj.as_deref())?,
            model: args.model.as_deref().map(readable_by).transpose()?,
            hides: args.hide.is_some(),
            measures: args.dimensions,
            frames: None,
            csv: tables,
            members: table.map(|path| beside(path, "members")),
            printed,
        })
    }

    /// From where they are seen.
    pub fn aspect(&self) -> Aspect {
        self.aspect
    }

    /// Whether anything is to be made.
    pub fn wanted(&self) -> bool {
        self.svg.is_some()
            || self.vtk.is_some()
            || self.csv.is_some()
            || self.model.is_some()
            || self.is_solid()
    }

    /// Whether blocks are to be written for programs that show them in space.
    fn is_solid(&self) -> bool {
        self.gltf.is_some() || self.obj.is_some()
    }

    /// The view with what was asked of all pictures.
    pub fn set(&self, view: &mut View) {
        (view.hides_supports, view.is_measured) = (self.hides, self.measures);
    }

    /// Refuses what changes no picture that is made.
    pub fn are_drawn(&self, page: bool) -> anyhow::Result<()> {
        if self.hides && !(page || self.svg.is_some() || self.is_solid()) {
            bail!("--hide requires --svg, --gltf, --obj or --report");
        }
        if self.measures && !(page || self.svg.is_some()) {
            bail!("--dimensions requires --svg or --report");
        }
        Ok(())
    }

    /// Whether one of them is what standard output holds.
    pub fn printed(&self) -> bool {
        self.printed > 0
    }

    /// Writes them.
    pub fn write(&self, view: &View) -> anyhow::Result<()> {
        self.write_model(view)?;
        self.write_still(view)
    }

    fn seen<'a>(&self, view: &'a View) -> Cow<'a, View> {
        let mut view = Cow::Borrowed(view);
        if self.hides || self.measures {
            self.set(view.to_mut());
        }
        view
    }

    /// Writes the model that moves.
    pub fn write_model(&self, view: &View) -> anyhow::Result<()> {
        let view = &self.seen(view);
        match &self.gltf {
            Some((sink, true)) => sink.write_bytes(&gltf::binary(view)?)?,
            Some((sink, false)) => sink.write(&gltf::text(view)?)?,
            None => {}
        }
        Ok(())
    }

    /// Writes all the others.
    pub fn write_still(&self, view: &View) -> anyhow::Result<()> {
        let view = &self.seen(view);
        if let Some(sink) = &self.obj {
            sink.write(&obj::obj(view))?;
        }
        if let Some((sink, program)) = &self.model {
            let file = models::model(view, *program)?;
            sink.write(&file.text)?;
            file.notes.iter().for_each(|note| say(&format!("note: --model: {note}")));
        }
        if let Some(svg) = &self.svg {
            svg.write(&drawing::svg(view, self.aspect))?;
        }
        match (&self.vtk, &self.frames) {
            (Some(sink), Some(folder)) => film(sink, folder, view)?,
            (Some(sink), None) => sink.write(&vtk::vtp(view))?,
            (None, _) => {}
        }
        if let Some([joints, blocks]) = &self.csv {
            joints.write(&table::joints(view).map_err(|e| anyhow::anyhow!("{e}"))?)?;
            blocks.write(&table::blocks(view).map_err(|e| anyhow::anyhow!("{e}"))?)?;
        }
        if let Some(path) = self.members.as_deref().filter(|_| !view.members.is_empty()) {
            let text = table::members(view).map_err(|e| anyhow::anyhow!("{e}"))?;
            Sink::open(Some(path))?.write(&text)?;
        }
        Ok(())
    }
}

/// One file a moment, the collection last: it names only what is there, and where it cannot be
/// written, nor can they. That of an earlier run, whose moments are replaced, goes first.
fn film(sink: &Sink, folder: &Path, view: &View) -> anyhow::Result<()> {
    let named = |k: usize| format!("{k:04}.vtp");
    if let Sink::File(target) = sink
        && let Err(e) = fs::remove_file(target)
        && e.kind() != ErrorKind::NotFound
    {
        return Err(e).with_context(|| format!("{}: cannot be replaced", target.display()));
    }
    let all = || {
        for (k, frame) in view.film.iter().enumerate() {
            Sink::open(Some(&folder.join(named(k))))?.write(&vtk::moment(view, frame))?;
        }
        let beside = folder.file_name().map(|n| n.to_string_lossy()).unwrap_or_default();
        sink.write(&vtk::collection(view, |k| format!("{beside}/{}", named(k))))
    };
    all().inspect_err(|_| {
        for k in 0..view.film.len() {
            let _ = fs::remove_file(folder.join(named(k)));
        }
        // Not where something else is in it.
        let _ = fs::remove_dir(folder);
    })
}

/// The file of a model, and the program that its ending names.
fn readable_by(path: &Path) -> anyhow::Result<(Sink, Program)> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let Some(program) = ending.as_deref().and_then(Program::of_ending) else {
        bail!(
            "--model {}: the ending says which program reads it: .xml for MuJoCo, .3ddat for 3DEC",
            path.display()
        );
    };
    Ok((Sink::open(Some(path))?, program))
}

fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// `forces.csv` → `forces.blocks.csv`.
fn beside(path: &Path, what: &str) -> PathBuf {
    let ending = path.extension().map_or(String::new(), |e| format!(".{}", e.to_string_lossy()));
    path.with_extension(format!("{what}{ending}"))
}
