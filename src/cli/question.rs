//! What all questions have in common: the scene in, the answer out.

use super::{
    args::{self, Common},
    claim, deadline,
    exit::{Exit, TimeIsUp},
    input,
    output::Sink,
    pictures::Pictures,
    progress::Watching,
    report, terminal,
    terminal::Terminal,
};
use anyhow::bail;
use std::{path::Path, time::Instant};
use voussoir::{
    analysis::{Answer, Control, Difference, Law, Question, Watch, Watcher, ask, ask_watched},
    deadline::{Deadline, clock},
    dynamics::Frame,
    error::{Finding, FindingCode, InputError},
    interface::{Model, prepare_timed},
    limits,
    proof::{ResultFile, answer::holds, saved, work::Work},
    question::QuestionKind as Kind,
    report::{
        chart::Chart,
        json,
        page::{self, SelfChecking},
        record::{self, Record},
        tell,
        text::{self, Asked, TextOptions},
        view::View,
    },
    scene::{Scene, Source},
    sweep::{self, Between},
    verdict::Verdict,
};

/// What a page shows beside an answer.
pub enum Depicted {
    /// The scene with the evidence of the answer, and what was filmed of a simulation.
    Scene(Vec<Frame>),
    /// The same, with charts of what was filmed.
    Charted(Vec<Frame>, Vec<Chart>),
    /// Something else.
    Other(Box<View>),
    /// The scene with the evidence of the answer on a page, and this in pictures.
    Drawn(Box<View>),
}

/// A scene that is ready for a question.
pub struct Session<'a> {
    common: &'a Common,
    save: Option<Sink>,
    report: Option<Sink>,
    /// What the page verifies itself by.
    checker: Option<Vec<u8>>,
    pictures: Pictures,
    source: Source,
    /// What was said when its meshes were read.
    said: Vec<Finding>,
    /// When programs have to end.
    deadline: Deadline,
    /// When the scene was ready.
    start: Instant,
    /// The scene as read.
    pub scene: Scene,
    /// The scene resolved, with its interfaces.
    pub model: Model,
}

/// Contacts are searched for so many seconds whatever the limit. More: limits of a second are no
/// limits. Less: small scenes have no answer that says what is open.
const PATIENCE: f64 = 1.0;

impl<'a> Session<'a> {
    /// Opens what will be written, then reads and prepares the scene.
    pub fn open(common: &'a Common) -> anyhow::Result<Self> {
        Self::open_changed(common, |scene| scene)
    }

    /// As [`Self::open`], asking about the scene that `change` makes of the one in the file.
    pub fn open_changed(
        common: &'a Common,
        change: impl FnOnce(Scene) -> Scene,
    ) -> anyhow::Result<Self> {
        if common.save.as_ref().is_some_and(|p| p.as_os_str() == "-") {
            bail!("--save needs a file; use --json to print the result");
        }
        if common.report.as_ref().is_some_and(|p| p.as_os_str() == "-") && common.json {
            bail!("--report - and --json both write to standard output; give --report a file");
        }
        for (option, path) in [("--save", &common.save), ("--report", &common.report)] {
            if let Some(path) = path.as_ref().filter(|path| is_same(path, &common.scene)) {
                bail!("{option} {} would overwrite the scene; name another file", path.display());
            }
        }
        claim::read(&common.scene)?;
        let save = common.save.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
        let report = common.report.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
        let checker = report::checker(common.self_checking.as_deref())?;
        let start = Instant::now();
        let deadline = deadline::of(common.time_limit);
        let (scene, source, said) = input::scene(&common.scene, common.outside.reach())?;
        let scene = match &common.combination {
            Some(name) => scene.in_combination(name).map_err(|e| source.located(e))?,
            None => scene,
        };
        let scene = change(scene);
        let read = start.elapsed().as_secs_f64();
        // An answer that says what is open is worth a second.
        let is_over = || deadline.is_over() && start.elapsed().as_secs_f64() > PATIENCE;
        let mut model = prepare_timed(&scene, &is_over, &clock).map_err(|e| -> anyhow::Error {
            match is_over() {
                true => TimeIsUp(e.to_string()).into(),
                false => source.located(e).into(),
            }
        })?;
        model.timings.read = read;
        model.assembly.said.clone_from(&said);
        terminal::warnings(model.findings());
        let points = model.contact_points() as u64;
        limits::afford(
            &format!("solving for {points} contact points"),
            points,
            limits::PER_CONTACT_POINT,
        )?;
        Ok(Self {
            common,
            save,
            report,
            checker,
            pictures: Pictures::default(),
            source,
            said,
            deadline,
            start: Instant::now(),
            scene,
            model,
        })
    }

    /// Opens the pictures that are wanted, and the tables.
    pub fn drawn(self, args: &args::Pictures, table: Option<&Path>) -> anyhow::Result<Self> {
        self.with_pictures(args, table, || Pictures::open(args, table))
    }

    /// As [`Self::drawn`], for what happens in time.
    pub fn filmed(self, args: &args::Pictures) -> anyhow::Result<Self> {
        self.with_pictures(args, None, || Pictures::open_film(args))
    }

    fn with_pictures(
        self,
        args: &args::Pictures,
        table: Option<&Path>,
        open: impl FnOnce() -> anyhow::Result<Pictures>,
    ) -> anyhow::Result<Self> {
        let given = [
            ("--svg", args.svg.as_deref()),
            ("--vtk", args.vtk.as_deref()),
            ("--gltf", args.gltf.as_deref()),
            ("--obj", args.obj.as_deref()),
            ("--model", args.model.as_deref()),
            ("--csv", table),
        ];
        for (option, path) in given.into_iter().filter_map(|(o, p)| Some((o, p?))) {
            if is_same(path, &self.common.scene) {
                bail!("{option} {} would overwrite the scene; name another file", path.display());
            }
        }
        let pictures = open()?;
        pictures.are_drawn(self.report.is_some())?;
        if pictures.printed() && (self.common.json || report::is_printed(&self.common.report)) {
            bail!(
                "only one of --svg, --vtk, --gltf, --obj, --model, --report and --json can go to standard output"
            );
        }
        Ok(Self { pictures, ..self })
    }

    /// Puts the worst case within ranges in the place of the scene, and the argument among what the
    /// user should know.
    pub fn worst(&mut self, ranges: &[Between], asked: &Question) -> anyhow::Result<()> {
        if ranges.is_empty() {
            return Ok(());
        }
        let refuse = |e: InputError| if e.path.0.is_empty() { e } else { self.source.located(e) };
        let worst = sweep::worst(&self.scene, ranges, asked, &self.control()).map_err(refuse)?;
        let read = self.model.timings.read;
        let mut model = prepare_timed(&worst.scene, &|| false, &clock).map_err(refuse)?;
        model.timings.read = read;
        let notes = worst
            .argument
            .into_iter()
            .map(|text| Finding::new(FindingCode::WorstCase, format!("worst case: {text}")));
        model.assembly.said = notes.chain(self.said.iter().cloned()).collect();
        (self.scene, self.model) = (worst.scene, model);
        Ok(())
    }

    /// How programs are run; how joints slide is for the question to say.
    pub fn control(&self) -> Control {
        let watcher: Watcher = if self.shows_progress() { Some(Watching::hear) } else { None };
        Control {
            keep_all: self.common.keep_all,
            deadline: self.deadline,
            watcher,
            ..Control::default()
        }
    }

    /// The law of sliding that was asked for.
    pub fn law(&self) -> Law {
        self.common.law.into()
    }

    /// Asks a question about the scene.
    pub fn ask(&self, question: &Question) -> anyhow::Result<Answer> {
        let _watch = self.shows_progress().then(Watching::begin);
        ask(question, &self.scene, &self.model, &self.control()).map_err(|e| self.refuse(e))
    }

    /// The same, of what happens in time: with somebody who watches.
    pub fn ask_watched(&self, question: &Question, watch: Watch) -> anyhow::Result<Answer> {
        if let Some(beyond) = dynamics::beyond(&self.model) {
            terminal::say(&format!("warning: {}", beyond.text));
        }
        ask_watched(question, &self.scene, &self.model, &self.control(), watch)
            .map_err(|e| self.refuse(e))
    }

    /// The result that proves an answer.
    pub fn result(&self, question: &Question, answer: &Answer) -> anyhow::Result<ResultFile> {
        saved::of_question(question, &self.scene, &self.model, answer, &self.control())
            .map_err(|e| self.refuse(e))
    }

    /// Whether a bar may show how far long work is.
    pub fn shows_progress(&self) -> bool {
        !self.common.quiet
    }

    /// Where the result goes, where it is to be saved.
    pub fn save(&self) -> Option<&Sink> {
        self.save.as_ref()
    }

    /// An error in the scene, with its place.
    pub fn refuse(&self, error: InputError) -> anyhow::Error {
        // What has no place in the scene is about the command line.
        if error.path.0.is_empty() { error.into() } else { self.source.located(error).into() }
    }

    /// What was read of the scene.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// Where the page goes, where there is to be one.
    pub fn report(&self) -> Option<&Sink> {
        self.report.as_ref()
    }

    /// The pictures that are wanted.
    pub fn pictures(&self) -> &Pictures {
        &self.pictures
    }

    /// Whether there is to be something to see: a page or pictures.
    pub fn is_filmed(&self) -> bool {
        self.report.is_some() || self.pictures.wanted()
    }

    /// Whether standard output holds a page or a picture.
    pub fn is_printed(&self) -> bool {
        report::is_printed(&self.common.report) || self.pictures.printed()
    }

    /// The joints that are used most, for who reads the answer in full.
    fn weak_joints(&self, file: &ResultFile) -> Vec<String> {
        let read = !(self.common.json || self.common.quiet) || self.report.is_some();
        if !read || !matches!(file.question.kind(), Kind::Assess | Kind::Limit) {
            return Vec::new();
        }
        let view = View::of_forces(&self.model, file);
        view.map_or_else(|_| Vec::new(), |view| record::weak(&self.model, &view))
    }

    /// Saves a result and prints it; `own` are the verb's own options that change the answer.
    pub fn answer(&self, terminal: &Terminal, file: ResultFile) -> anyhow::Result<ResultFile> {
        self.answer_seen(terminal, Depicted::Scene(Vec::new()), file)
    }

    /// As [`Self::answer`], and says what a page shows.
    pub fn answer_seen(
        &self,
        terminal: &Terminal,
        seen: Depicted,
        mut file: ResultFile,
    ) -> anyhow::Result<ResultFile> {
        if let Some(s) = &file.simulation {
            file.run.timings.simulate = s.runs.iter().map(|r| r.seconds).sum();
        }
        file.run.timings.solve = (self.start.elapsed().as_secs_f64()
            - file.run.timings.simulate
            - file.run.timings.check)
            .max(0.0);
        file.run.work = Some(Work::of(&file, &self.model));
        let scene = match self.common.scene.to_string_lossy() {
            name if name == "-" => "SCENE".into(),
            name => quoted(&name),
        };
        let weak = self.weak_joints(&file);
        let asked = Asked { scene: &scene, options: &terminal.again, weak: &weak };
        let layout = terminal.layout(&self.common.scene);
        // Said to who reads numbers or pictures alone, too.
        if let Some(words) = text::left_out(&file) {
            terminal::say(&format!("warning: {words}"));
        }
        if let Some(save) = &self.save {
            save.write(&json::text(&file.to_value()?))?;
        }
        if self.is_filmed() {
            let mut charts = Vec::new();
            let (mut view, drawn) = match seen {
                Depicted::Charted(film, own) => {
                    charts = own;
                    (View::new(&self.model, &file, film)?, None)
                }
                Depicted::Scene(film) => (View::new(&self.model, &file, film)?, None),
                Depicted::Other(view) => (*view, None),
                Depicted::Drawn(view) => (View::new(&self.model, &file, Vec::new())?, Some(*view)),
            };
            self.pictures.set(&mut view);
            if let Some(report) = &self.report {
                let text = text::render(&file, asked, report::EVERYTHING, report::layout(layout));
                charts.extend(tell::charts(&file).into_iter().chain(tell::attempts(&file)));
                let command = text::command(&file, asked);
                let origin = report::origin(&self.common.scene, &self.source.text, command);
                let from = self.pictures.aspect();
                let record = Record::new(&file, &self.model, &view, from, &origin);
                let checking = match &self.checker {
                    Some(module) => {
                        Some(SelfChecking { module: module.clone(), result: file.to_value()? })
                    }
                    None => None,
                };
                let checking = checking.as_ref();
                report.write(&page::self_checking(&text, &view, &charts, &record, checking)?)?;
            }
            // Stages are one film, and drawn by the worst of them.
            let staged = file.question.kind() == Kind::Stages;
            if staged {
                self.pictures.write_model(&view)?;
            }
            let films = [Kind::Simulate, Kind::Shake, Kind::Settle, Kind::Push];
            if !films.contains(&file.question.kind()) {
                // A verdict is drawn with its mechanism, whatever else was seen.
                view.film.clear();
            }
            let still = drawn.as_ref().unwrap_or(&view);
            if !staged {
                self.pictures.write_model(still)?;
            }
            self.pictures.write_still(still)?;
        }
        if self.common.json {
            terminal::print(&json::text(&file.to_value()?))?;
        } else if !self.is_printed() {
            let options = TextOptions { verbose: self.common.verbose, brief: self.common.quiet };
            terminal.page(&text::render(&file, asked, options, layout))?;
        }
        Ok(file)
    }
}

/// Whether two paths name one file.
fn is_same(a: &Path, b: &Path) -> bool {
    a.canonicalize().ok().zip(b.canonicalize().ok()).is_some_and(|(a, b)| a == b)
}

/// A word as a shell takes it whole.
pub fn quoted(word: &str) -> String {
    if word.chars().all(|c| c.is_alphanumeric() || "/._-+=:,@%\\".contains(c)) {
        return word.to_string();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// An exit code that says yes says so no more where the answer is weaker with contacts that were
/// left out, nor is it yes or no where it is other numbers: which of the two the scene is nobody
/// knows.
pub fn unless_weaker(file: &ResultFile, exit: Exit) -> Exit {
    let closed = file.left_out_contacts.as_ref().and_then(|l| l.closed.as_ref());
    match closed.map(|c| c.difference) {
        Some(Difference::Weaker) if exit == Exit::Yes => Exit::Undecided,
        Some(Difference::Another) => Exit::Undecided,
        _ => exit,
    }
}

/// The exit code of a verdict.
pub fn verdict(verdict: Option<Verdict>) -> Exit {
    match verdict {
        Some(Verdict::Stable) => Exit::Yes,
        Some(Verdict::Unstable | Verdict::Conditional) => Exit::No,
        Some(Verdict::Undecided) | None => Exit::Undecided,
    }
}

/// The exit code of a load factor or an angle, by what is required of it.
pub fn requirement(file: &ResultFile) -> Exit {
    match holds(&file.question, &file.scene.input, &file.answer) {
        Some(true) => Exit::Yes,
        Some(false) => Exit::No,
        None => Exit::Undecided,
    }
}
