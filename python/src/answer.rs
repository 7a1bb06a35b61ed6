//! Answers: the result file with its model, and everything that is made of them.

use crate::{arrays, error::Trouble, scene::told};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::{exceptions::PyKeyError, prelude::*};
use pythonize::pythonize;
use std::sync::{Arc, OnceLock};
use voussoir::{
    dynamics::{Fidelity, Frame, Pose},
    interface::{Model, prepare},
    proof::{
        PackingFile, ResultFile, Saved, VerificationFile, certificate::Certificate, read,
        recompute::JustComputed, verify, verify::verify_model,
    },
    report::{
        drawing::{self, Aspect},
        gltf, json, models, obj, page,
        record::{Origin, Record},
        table, tell,
        text::{self, Asked, Layout, TextOptions},
        view::View,
        vtk,
    },
    verdict::evidence::ContactForces,
};

/// A page holds all that can be said.
const EVERYTHING: TextOptions = TextOptions { verbose: true, brief: false };

/// An answer.
#[pyclass(module = "voussoir._core", frozen)]
pub struct Answer {
    kept: Arc<Kept>,
}

struct Kept {
    file: ResultFile,
    /// The scene that the answer is about; of an answer that was read, made when it is needed.
    model: OnceLock<Arc<Model>>,
    film: Vec<Frame>,
    packed: Option<Packed>,
}

/// The answer about a packing, of which the file is the proof.
pub struct Packed {
    pub file: PackingFile,
    pub scene: Arc<voussoir::scene::Scene>,
}

/// The result, its film and, of a packing, the answer and its scene.
type State<'py> = (String, Bound<'py, PyArray2<f64>>, Option<(String, String)>);

/// Joints, offsets, contact points, forces, couples.
type Flat<'py> = (
    Vec<(String, String)>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

impl Answer {
    pub fn new(
        file: ResultFile,
        model: Arc<Model>,
        film: Vec<Frame>,
        packed: Option<Packed>,
    ) -> Self {
        Self { kept: Arc::new(Kept { file, model: model.into(), film, packed }) }
    }

    fn certificate(&self, which: &str) -> Option<&Certificate> {
        let file = &self.kept.file;
        Some(match which {
            "answer" => &file.certificate,
            "dry" => &file.dry.as_ref()?.certificate,
            "dead_load" => &file.dead_load.as_ref()?.certificate,
            "least" => &file.thrust.as_ref()?.least,
            "greatest" => &file.thrust.as_ref()?.greatest,
            _ => {
                let (list, k) = which.split_once('/')?;
                let k: usize = k.parse().ok()?;
                match list {
                    "directions" => &file.directions.get(k)?.certificate,
                    "path" => &file.path.as_ref()?.points.get(k)?.certificate,
                    "ends" => &file.path.as_ref()?.ends.get(k)?.certificate,
                    _ => return None,
                }
            }
        })
    }

    fn options(&self) -> Asked<'static> {
        Asked { scene: "SCENE", ..Asked::default() }
    }
}

impl Kept {
    fn read(name: String, text: String) -> Result<Self, Trouble> {
        let saved = read::read_str(name.clone(), text)?;
        let model = prepare(&saved.scene)?;
        // What only a solver can do again is left to `verify`.
        let found = verify_model(&saved, &saved.scene, &model, &JustComputed);
        let fails = found.parts.iter().flat_map(|(title, f)| f.fails.first().zip(Some(title)));
        if let Some((why, title)) = fails.take(1).next() {
            return Err(Trouble::other(format!("{name} is refuted: {title}: {why}")));
        }
        let file = found.file.ok_or_else(|| Trouble::other(format!("{name} is refuted")))?;
        let model = OnceLock::from(Arc::new(model));
        Ok(Self { file, model, film: Vec::new(), packed: None })
    }

    fn model(&self) -> Result<Arc<Model>, Trouble> {
        if let Some(model) = self.model.get() {
            return Ok(model.clone());
        }
        let model = Arc::new(prepare(&self.file.scene.input)?);
        Ok(self.model.get_or_init(|| model).clone())
    }

    fn view(&self) -> Result<View, Trouble> {
        View::new(&*self.model()?, &self.file, self.film.clone()).map_err(Trouble::other)
    }
}

/// A frame as a row: time, settings, displacement, energy, then 13 numbers a block.
fn frame_row(frame: &Frame) -> Vec<f64> {
    let fine = f64::from(u8::from(frame.fidelity == Fidelity::Fine));
    let body = |p: &Pose| {
        let Pose { center: c, turn: q, velocity: v, spin: s } = p;
        [c.x, c.y, c.z, q.w, q.i, q.j, q.k, v.x, v.y, v.z, s.x, s.y, s.z]
    };
    let head = [frame.time, fine, frame.relative, frame.energy];
    head.into_iter().chain(frame.blocks.iter().flat_map(body)).collect()
}

fn frame(row: &[f64]) -> Frame {
    let (head, blocks) = row.split_at(row.len().min(4));
    let head = |k: usize| head.get(k).copied().unwrap_or(f64::NAN);
    let body = |p: &[f64; 13]| {
        let [x, y, z, w, i, j, k, vx, vy, vz, sx, sy, sz] = *p;
        Pose {
            center: Vector3::new(x, y, z),
            turn: UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)),
            velocity: Vector3::new(vx, vy, vz),
            spin: Vector3::new(sx, sy, sz),
        }
    };
    Frame {
        time: head(0),
        fidelity: if head(1) == 1.0 { Fidelity::Fine } else { Fidelity::Fast },
        relative: head(2),
        energy: head(3),
        blocks: blocks.as_chunks::<13>().0.iter().map(body).collect(),
    }
}

/// What is made of an answer while the interpreter is free.
fn made<T: Send>(
    py: Python,
    kept: &Kept,
    make: impl FnOnce(&Kept) -> Result<T, Trouble> + Send,
) -> PyResult<T> {
    py.detach(|| make(kept)).map_err(|e| e.raise(py))
}

#[pymethods]
impl Answer {
    /// Reads a saved result.
    #[staticmethod]
    fn read(py: Python, name: String, text: String) -> PyResult<Self> {
        let kept = py.detach(|| Kept::read(name, text)).map_err(|e| e.raise(py))?;
        Ok(Self { kept: Arc::new(kept) })
    }

    /// What [`restored`](Self::restored) makes the same answer of: the result, its film (a row a
    /// frame) and, of a packing, the answer with its scene.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<State<'py>> {
        let Kept { film, packed, .. } = &*self.kept;
        let text = |packed: &Packed| {
            Ok((serde_json::to_string(&packed.file)?, serde_json::to_string(&*packed.scene)?))
        };
        let packed = packed.as_ref().map(text).transpose();
        let packed = packed.map_err(|e: serde_json::Error| Trouble::other(e).raise(py))?;
        let rows: Vec<Vec<f64>> = film.iter().map(frame_row).collect();
        let film = PyArray2::from_vec2(py, &rows).map_err(|e| Trouble::other(e).raise(py))?;
        Ok((self.json(py)?, film, packed))
    }

    /// An answer of its state.
    #[staticmethod]
    fn restored(
        py: Python,
        text: String,
        film: PyReadonlyArray2<f64>,
        packed: Option<(String, String)>,
    ) -> PyResult<Self> {
        let film = film.as_array().rows().into_iter().map(|r| frame(&r.to_vec())).collect();
        let restore = || {
            let packed = packed.map(|(file, scene)| {
                let scene = Arc::new(serde_json::from_str(&scene)?);
                Ok::<_, serde_json::Error>(Packed { file: serde_json::from_str(&file)?, scene })
            });
            let packed = packed.transpose().map_err(Trouble::other)?;
            let kept = Kept::read("the pickled answer".into(), text)?;
            Ok::<_, Trouble>(Kept { film, packed, ..kept })
        };
        let kept = py.detach(restore).map_err(|e| e.raise(py))?;
        Ok(Self { kept: Arc::new(kept) })
    }

    /// What was asked.
    fn question<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pythonize(py, self.kept.file.question.word())?)
    }

    /// A part of the result as plain values; `None` where it has none.
    fn part<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let f = &self.kept.file;
        Ok(match name {
            "answer" => pythonize(py, &f.answer)?,
            "mechanism" => pythonize(py, &f.mechanism)?,
            "members" => pythonize(py, &f.members)?,
            "directions" => {
                pythonize(py, &f.directions.iter().map(|d| &d.answer).collect::<Vec<_>>())?
            }
            "doubt" => pythonize(py, &f.run.doubt)?,
            "required" => pythonize(py, &f.required)?,
            "sensitivity" => pythonize(py, &f.sensitivity)?,
            "left_out_contacts" => pythonize(py, &f.left_out_contacts)?,
            "left_out" => pythonize(py, &f.run.left_out)?,
            "simulation" => pythonize(py, &f.simulation)?,
            "frames" => pythonize(py, &f.run.frames)?,
            "path" => pythonize(py, &f.path)?,
            "thrust" => pythonize(py, &f.thrust)?,
            "critical" => pythonize(py, &f.critical)?,
            "state_under_dry_friction" => pythonize(py, &f.motion)?,
            "dry" => pythonize(py, &f.dry)?,
            "why" => pythonize(py, &f.run.why)?,
            "timings" => pythonize(py, &f.run.timings)?,
            "work" => pythonize(py, &f.run.work)?,
            "scene" => pythonize(py, &f.scene.counts)?,
            "packing" => pythonize(py, &self.kept.packed.as_ref().map(|p| &p.file))?,
            _ => return Err(PyKeyError::new_err(name.to_string())),
        })
    }

    /// The scene of the answer.
    fn scene(&self) -> crate::scene::Scene {
        let packed = self.kept.packed.as_ref().map(|p| (*p.scene).clone());
        crate::scene::Scene::of_scene(packed.unwrap_or_else(|| self.kept.file.scene.input.clone()))
    }

    /// The name of the scene.
    fn name(&self) -> &str {
        &self.kept.file.scene.name
    }

    /// What the user should know.
    fn warnings(&self) -> Vec<(String, String, bool, bool)> {
        self.kept.file.warnings().map(told).collect()
    }

    /// A certificate: its claim as plain values, what its check found; `None` where there is none.
    fn claim<'py>(
        &self,
        py: Python<'py>,
        which: &str,
    ) -> PyResult<Option<(Bound<'py, PyAny>, Vec<String>)>> {
        let Some(certificate) = self.certificate(which) else { return Ok(None) };
        Ok(Some((pythonize(py, &certificate.claim)?, certificate.verified())))
    }

    /// The forces of a certificate in flat arrays; `None` where there is none.
    fn forces<'py>(&self, py: Python<'py>, which: &str) -> Option<Flat<'py>> {
        Some(flat(py, &self.certificate(which)?.forces))
    }

    /// The rates of a certificate: blocks, velocities, spins; `None` where there is none.
    #[allow(clippy::type_complexity)]
    fn rates<'py>(
        &self,
        py: Python<'py>,
        which: &str,
    ) -> Option<(Vec<String>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>)> {
        let rates = &self.certificate(which)?.rates;
        Some((
            rates.iter().map(|r| r.block.clone()).collect(),
            arrays::rows(py, rates.iter().map(|r| r.velocity).collect()),
            arrays::rows(py, rates.iter().map(|r| r.spin).collect()),
        ))
    }

    /// The blocks: ids, whether they are supports, masses, centres of mass.
    #[allow(clippy::type_complexity)]
    fn blocks<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Vec<String>, Vec<bool>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>)>
    {
        let model = made(py, &self.kept, Kept::model)?;
        let blocks = &model.assembly.blocks;
        Ok((
            blocks.iter().map(|b| b.id.clone()).collect(),
            blocks.iter().map(|b| b.support).collect(),
            arrays::numbers(py, blocks.iter().map(|b| b.mass).collect()),
            arrays::rows(py, blocks.iter().map(|b| b.centroid.into()).collect()),
        ))
    }

    /// The frames of the joints, rows `t1`, `t2`, `n` of each, and their areas, m²; in the order of
    /// the forces.
    #[allow(clippy::type_complexity)]
    fn frames<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>)> {
        let model = made(py, &self.kept, Kept::model)?;
        let list = &model.interfaces.list;
        let frame = |f: &voussoir::interface::ContactFrame| [f.t1, f.t2, f.n].map(Into::into);
        Ok((
            arrays::rows(py, list.iter().flat_map(|f| frame(&f.frame)).collect()),
            arrays::numbers(py, list.iter().map(|f| f.area).collect()),
        ))
    }

    /// The result as the command saves it.
    fn json(&self, py: Python) -> PyResult<String> {
        made(py, &self.kept, |kept| json::pretty(&kept.file).map_err(Trouble::other))
    }

    /// The answer about a packing as the command prints it with `--json`.
    fn packing_json(&self, py: Python) -> PyResult<Option<String>> {
        made(py, &self.kept, |kept| {
            let file = kept.packed.as_ref().map(|p| json::pretty(&p.file));
            file.transpose().map_err(Trouble::other)
        })
    }

    /// The answer in words.
    #[pyo3(signature = (brief=false, verbose=false))]
    fn text(&self, brief: bool, verbose: bool) -> String {
        let (options, layout) = (TextOptions { verbose, brief }, Layout::default());
        match &self.kept.packed {
            Some(packed) => text::packing(&packed.file, options, layout).to_string(),
            None => text::render(&self.kept.file, self.options(), options, layout).to_string(),
        }
    }

    /// What contacts that were left out change, in words, where they are worth a warning.
    fn left_out_words(&self) -> Option<String> {
        text::left_out(&self.kept.file)
    }

    /// The answer as a page for a browser.
    fn page(&self, py: Python) -> PyResult<String> {
        let asked = self.options();
        made(py, &self.kept, |kept| {
            let layout = Layout { width: usize::MAX, ..Layout::default() };
            let words = match &kept.packed {
                Some(packed) => text::packing(&packed.file, EVERYTHING, layout),
                None => text::render(&kept.file, asked, EVERYTHING, layout),
            };
            let charts = tell::attempts(&kept.file);
            let view = kept.view()?;
            let record = match &kept.packed {
                Some(_) => Record::default(),
                None => {
                    // Without a date: the same answer makes the same page.
                    let (model, origin) = (kept.model()?, Origin::default());
                    Record::new(&kept.file, &model, &view, Aspect::Auto, &origin)
                }
            };
            page::filed(&words, &view, charts.as_slice(), &record).map_err(Trouble::other)
        })
    }

    /// A drawing.
    #[pyo3(signature = (aspect=None))]
    fn svg(&self, py: Python, aspect: Option<&str>) -> PyResult<String> {
        let aspect = aspect.map(str::parse::<Aspect>).transpose();
        let aspect = aspect.map_err(|e| Trouble::other(e).raise(py))?.unwrap_or_default();
        made(py, &self.kept, |kept| {
            let mut view = kept.view()?;
            view.film.clear();
            Ok(drawing::svg(&view, aspect))
        })
    }

    /// A file for ParaView.
    fn vtp(&self, py: Python) -> PyResult<String> {
        made(py, &self.kept, |kept| Ok(vtk::vtp(&kept.view()?)))
    }

    /// glTF 2.0 as text.
    fn gltf(&self, py: Python) -> PyResult<String> {
        made(py, &self.kept, |kept| gltf::text(&kept.view()?).map_err(Trouble::other))
    }

    /// glTF 2.0 as a binary container.
    fn glb(&self, py: Python) -> PyResult<Vec<u8>> {
        made(py, &self.kept, |kept| gltf::binary(&kept.view()?).map_err(Trouble::other))
    }

    /// The displaced blocks (OBJ).
    fn obj(&self, py: Python) -> PyResult<String> {
        made(py, &self.kept, |kept| Ok(obj::obj(&kept.view()?)))
    }

    /// A model of another program, by the ending of its file, and what is not in it.
    fn model(&self, py: Python, ending: &str) -> PyResult<(String, Vec<String>)> {
        let Some(program) = models::Program::of_ending(ending) else {
            return Err(Trouble::Other(format!(
                "{ending:?} names no program; endings are .xml for MuJoCo, .3ddat for 3DEC"
            ))
            .raise(py));
        };
        made(py, &self.kept, move |kept| {
            let file = models::model(&kept.view()?, program).map_err(Trouble::other)?;
            Ok((file.text, file.notes))
        })
    }

    /// A table with commas: `joints`, `blocks`, `members` or `path`.
    fn csv(&self, py: Python, which: &str) -> PyResult<String> {
        let which = which.to_string();
        made(py, &self.kept, move |kept| match which.as_str() {
            "joints" => table::joints(&kept.view()?).map_err(Trouble::other),
            "blocks" => table::blocks(&kept.view()?).map_err(Trouble::other),
            "members" => table::members(&kept.view()?).map_err(Trouble::other),
            "path" => tell::csv(&kept.file).map_err(Trouble::other),
            other => Err(Trouble::Other(format!(
                "there is no table {other}; the tables are joints, blocks, members and path"
            ))),
        })
    }

    /// Frames of the film: times (s), poses `frames × blocks × 7`.
    #[allow(clippy::type_complexity)]
    fn film<'py>(&self, py: Python<'py>) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        let film = &self.kept.film;
        let row = |p: &Pose| {
            let (c, q) = (p.center, p.turn);
            [c.x, c.y, c.z, q.w, q.i, q.j, q.k]
        };
        let poses = film.iter().flat_map(|f| f.blocks.iter().flat_map(row)).collect();
        (arrays::numbers(py, film.iter().map(|f| f.time).collect()), arrays::numbers(py, poses))
    }

    /// Proves the result from its scene, or from another: the verification as plain values.
    #[pyo3(signature = (scene=None))]
    fn verify<'py>(
        &self,
        py: Python<'py>,
        scene: Option<&crate::scene::Scene>,
    ) -> PyResult<(Bound<'py, PyAny>, String)> {
        let saved = self.kept.file.saved().map_err(|e| Trouble::other(e).raise(py))?;
        verified(py, saved, scene)
    }
}

/// Verifies a saved result, from its scene or from another: the verification as plain values.
#[pyfunction]
#[pyo3(signature = (name, text, scene=None))]
pub fn check_saved<'py>(
    py: Python<'py>,
    name: String,
    text: String,
    scene: Option<&crate::scene::Scene>,
) -> PyResult<(Bound<'py, PyAny>, String)> {
    let saved = read::read_str(name, text).map_err(|e| Trouble::from(e).raise(py))?;
    verified(py, saved, scene)
}

fn verified<'py>(
    py: Python<'py>,
    saved: Saved,
    scene: Option<&crate::scene::Scene>,
) -> PyResult<(Bound<'py, PyAny>, String)> {
    let other = scene.map(|s| s.ready());
    let name = saved.scene.name.clone();
    let found = crate::wait::run(py, None, move |_| {
        let scene = other.as_ref().map_or(&saved.scene, |r| &*r.scene);
        verify(&saved, scene).map_err(|e| match &other {
            Some(ready) => ready.located(e),
            None => e.into(),
        })
    })?;
    let words = text::verification(&name, found.file.as_ref(), &found, Layout::default());
    Ok((pythonize(py, &VerificationFile::new(&name, &found))?, words.to_string()))
}

fn flat<'py>(py: Python<'py>, forces: &[ContactForces]) -> Flat<'py> {
    let points = forces.iter().map(|c| c.points.len()).sum();
    let mut offsets = Vec::with_capacity(forces.len() + 1);
    let (mut at, mut force) = (Vec::with_capacity(points), Vec::with_capacity(points));
    let mut couples = Vec::new();
    offsets.push(0);
    for contact in forces {
        at.extend_from_slice(&contact.points);
        force.extend_from_slice(&contact.forces);
        if !contact.couples.is_empty() {
            couples.resize(force.len() - contact.forces.len(), [0.0; 3]);
            couples.extend_from_slice(&contact.couples);
        }
        offsets.push(at.len() as i64);
    }
    if !couples.is_empty() {
        couples.resize(force.len(), [0.0; 3]);
    }
    let between = forces.iter().map(|c| (c.between[0].clone(), c.between[1].clone())).collect();
    (
        between,
        arrays::counts(py, &offsets),
        arrays::rows(py, at),
        arrays::rows(py, force),
        arrays::rows(py, couples),
    )
}
