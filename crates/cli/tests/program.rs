//! The program from outside: what it prints, where it fails and how.

use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use tiny_physics::{SimdLevel, Stage};
use tiny_physics_scenes::{all, tags};

fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tiny-physics"))
        .args(arguments)
        .stdin(Stdio::null())
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// What it prints where it succeeds.
fn good(arguments: &[&str]) -> String {
    let output = program(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// What it complains about where it fails.
fn bad(arguments: &[&str]) -> String {
    let output = program(arguments);
    assert!(!output.status.success(), "{arguments:?} succeeded: {}", text(&output.stdout));
    assert!(output.stdout.is_empty(), "{}", text(&output.stdout));
    text(&output.stderr)
}

fn scratch(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

#[test]
fn without_a_terminal_the_demo_plays_by_itself() {
    for arguments in [&[][..], &["demo"], &["--seed", "3"], &["demo", "--seed", "3"]] {
        let out = good(arguments);
        assert!(out.matches("--- frame").count() >= 3, "{out}");
        assert!(out.contains('#') && out.contains('o') && out.contains('[') && out.contains(']'));
        assert!(out.contains("came to rest"), "{out}");
    }
    assert_eq!(good(&["--seed", "3"]), good(&["demo", "--seed", "3"]));
}

#[test]
fn what_cannot_be_written_is_named() {
    let words = bad(&["record", "seed_demo", "--steps", "5", "-o", "no/such/folder/x.tpr"]);
    assert!(words.contains("cannot write 'no/such/folder/x.tpr'"), "{words}");
    let file = scratch("in_the_way");
    std::fs::write(&file, "").unwrap();
    let folder = file.join("pictures").to_string_lossy().into_owned();
    let output = program(&["doctor", "seed_demo", "--steps", "5", "--pictures", &folder]);
    let words = text(&output.stderr);
    assert!(words.contains("cannot write") && words.contains("in_the_way"), "{words}");
}

#[test]
fn help_has_examples_everywhere() {
    assert!(good(&["--help"]).contains("Examples:"));
    for command in ["demo", "list", "run", "bench", "render", "view"] {
        assert!(good(&[command, "--help"]).contains("Examples:"), "{command}");
    }
}

#[test]
fn list_names_the_scenes() {
    let out = good(&["list"]);
    assert!(out.contains("seed_demo") && out.contains("large_pyramid"), "{out}");
    let json: serde_json::Value = serde_json::from_str(&good(&["list", "--json"])).unwrap();
    assert!(json.as_array().unwrap().len() > 5);
}

#[test]
fn the_report_has_its_fields_and_no_others() {
    let out = good(&["run", "seed_demo", "--steps", "30", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&out).unwrap();
    let report = json.as_object().unwrap();
    let mut names: Vec<_> = report.keys().map(String::as_str).collect();
    names.sort_unstable();
    let mut expected = vec![
        "scene",
        "steps",
        "bodies",
        "shapes",
        "joints",
        "contacts",
        "awake_bodies",
        "threads",
        "simd",
        "ms_per_step",
        "stage_ms",
        "worst_penetration_m",
        "max_penetration_m",
        "ended",
        "fastest_m_s",
        "kinetic_energy_j",
        "hash",
        "findings",
    ];
    expected.sort_unstable();
    assert_eq!(names, expected);
    for time in ["mean", "median", "p99", "max"] {
        assert!(report["ms_per_step"][time].is_f64(), "{time}");
    }
    assert!(!report["stage_ms"].as_object().unwrap().is_empty());
    assert_eq!(report["steps"], 30);
    assert_eq!(report["bodies"], 24);
    let hash = report["hash"].as_str().unwrap();
    assert!(hash.len() == 16 && hash.chars().all(|c| c.is_ascii_hexdigit()), "{hash}");
}

#[test]
fn a_run_ends_with_what_the_doctor_says() {
    let out = good(&["run", "bowl", "--steps", "30"]);
    assert!(out.contains("\ndoctor       warning: overlap_at_start: body "), "{out}");
    let json = good(&["run", "bowl", "--steps", "30", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["findings"][0]["code"], "overlap_at_start");
}

#[test]
fn bench_prints_a_row_for_each_level() {
    let args = ["bench", "stack", "newton_cradle", "--steps", "20", "--repeat", "2", "--json"];
    let rows: Vec<serde_json::Value> =
        good(&args).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let levels: Vec<_> = SimdLevel::available().map(SimdLevel::name).collect();
    assert_eq!(rows.len(), 2 * levels.len());
    for (i, row) in rows.iter().enumerate() {
        let scene = ["stack", "newton_cradle"][i / levels.len()];
        assert_eq!(
            (&row["scene"], &row["simd"]),
            (&scene.into(), &levels[i % levels.len()].into())
        );
        assert_eq!((&row["steps"], &row["repeat"]), (&19.into(), &2.into()));
        assert_eq!(row["hash"], rows[i / levels.len() * levels.len()]["hash"]);
        let number = |name: &str| row[name].as_f64().unwrap_or_else(|| panic!("{name}: {row}"));
        let stages = row["stage_ms"].as_object().unwrap();
        assert_eq!(stages.len(), Stage::ALL.len());
        let sum: f64 = stages.values().map(|ms| ms.as_f64().unwrap()).sum();
        assert!(sum > 0.0 && number("ms") > 0.0 && number("p99_ms") >= number("median_ms"));
        assert!(row["ms_range"][0].as_f64() <= row["ms"].as_f64());
        assert!(!cfg!(unix) || number("cpu_ms") > 0.0, "{row}");
        let bodies = number("moving");
        let cost_ms = row["cpu_ms"].as_f64().unwrap_or_else(|| number("ms"));
        assert!((number("ns_per_body") * bodies / (cost_ms * 1.0e6) - 1.0).abs() < 1.0e-9);
    }
}

#[test]
fn bench_prints_a_table() {
    let out = good(&["bench", "stack", "--steps", "10", "--repeat", "1", "--simd", "scalar"]);
    let lines: Vec<_> = out.lines().filter(|line| !line.is_empty()).collect();
    assert!(lines[0].starts_with("stack: 9 timed steps, median of 1"), "{out}");
    assert!(lines[1].contains("narrow_phase") && lines[2].starts_with("scalar"), "{out}");
    assert_eq!(lines.len(), 3);
}

/// The rows of some figures, small and quick.
fn figures(which: &str, more: &[&str]) -> Vec<serde_json::Value> {
    let which = format!("--figures={which}");
    let arguments = ["bench", &which, "--repeat", "1", "--bodies", "100,2000", "--json"];
    let out = good(&[&arguments, more].concat());
    out.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn number(row: &serde_json::Value, name: &str) -> f64 {
    let parts = name.split('.').fold(row, |row, name| &row[name]);
    parts.as_f64().unwrap_or_else(|| panic!("{name}: {row}"))
}

#[test]
fn memory_is_told_by_body_and_by_contact() {
    let rows = figures("memory", &[]);
    let scenes: Vec<_> = rows.iter().map(|row| row["scene"].as_str().unwrap()).collect();
    assert_eq!(scenes, ["large_pyramid", "pentagons", "circles", "circles"]);
    for row in &rows {
        let number = |name| number(row, name);
        assert!((500.0..1500.0).contains(&number("body.used")), "{row}");
        assert!((200.0..2000.0).contains(&number("contact.used")), "{row}");
        assert!(number("body.held") >= number("body.used"), "{row}");
        let parts = row["parts"].as_object().unwrap().iter();
        // Constraints are a part of the graph.
        let parts = parts.filter(|(name, _)| *name != "constraints").map(|(_, part)| &part["held"]);
        let sum: f64 = parts.map(|held| held.as_f64().unwrap()).sum();
        assert_eq!(number("total.held"), sum);
        assert!(number("total.used") > number("body.used") * number("bodies") - number("bodies"));
        assert!(!cfg!(target_os = "linux") || row["resident"].is_u64(), "{row}");
    }
}

#[test]
fn changes_and_stages_have_a_row_a_size() {
    let rows = figures("changes,stages", &["--steps", "4"]);
    let sizes: Vec<_> =
        rows.iter().map(|row| row["added"].as_u64().or(row["bodies"].as_u64())).collect();
    assert_eq!(sizes, [100, 2000, 100, 2000, 100, 2000].map(Some));
    for row in &rows[..4] {
        for time in
            ["add_ns", "first_step_ns", "second_step_ns", "remove_ns", "next_step_ns", "again_ns"]
        {
            assert!(number(row, time) > 0.0, "{row}");
        }
    }
    assert!(number(&rows[0], "before") == 0.0 && number(&rows[3], "before") == 2000.0);
    for row in &rows[4..] {
        let stages = row["stage_ns"].as_object().unwrap();
        assert_eq!(stages.len(), Stage::ALL.len());
        assert!(number(row, "total_ns") >= number(row, "stage_ns.solve"), "{row}");
        assert!(number(row, "traffic.solve_in_order") > 176.0 && number(row, "megabytes") > 0.0);
    }
}

#[test]
fn bandwidth_has_a_row_a_size() {
    let rows = figures("bandwidth", &["--mebibytes", "1,2"]);
    assert_eq!(rows.len(), 2);
    for (row, size) in rows.iter().zip([1.0, 2.0]) {
        assert_eq!(number(row, "mebibytes"), size);
        let line_gb = 64.0 / number(row, "gather_ns");
        assert!((line_gb / number(row, "gather_gb") - 1.0).abs() < 1.0e-6, "{row}");
        assert!(number(row, "read_gb") > 0.0 && number(row, "update_gb") > 0.0);
    }
}

#[test]
fn figures_are_tables_too() {
    let arguments = ["--repeat", "1", "--bodies", "100", "--mebibytes", "1"];
    let which = "--figures=memory,changes,stages,bandwidth";
    let out = good(&[&["bench", which][..], &arguments].concat());
    let lines: Vec<_> = out.lines().filter(|line| !line.is_empty()).collect();
    assert_eq!(lines.len(), (2 + 3) + (2 + 2) + (2 + 1) + (2 + 1), "{out}");
    assert!(lines[1].starts_with("scene") && lines[4].starts_with("circles"), "{out}");
}

#[test]
fn bench_says_what_it_does_not_know() {
    let error = bad(&["bench", "stack", "large_piramid"]);
    assert!(error.contains("'large_piramid'") && error.contains("'large_pyramid'"), "{error}");
    assert!(bad(&["bench", "stack", "--simd", "mmx"]).contains("mmx"));
    assert!(bad(&["bench", "stack", "--repeat", "0"]).contains("--repeat"));
    assert!(bad(&["bench", "stack", "--figures"]).contains("--figures"));
    assert!(bad(&["bench", "--figures=memories"]).contains("memory"));
    assert!(bad(&["bench", "--figures=memory", "--bodies", "0"]).contains("--bodies"));
}

#[test]
fn neither_threads_nor_simd_change_the_hash() {
    let hash = |more: &[&str]| {
        let arguments = [&["run", "seed_demo", "--steps", "200", "--json"][..], more].concat();
        let json: serde_json::Value = serde_json::from_str(&good(&arguments)).unwrap();
        json["hash"].clone()
    };
    let expected = hash(&[]);
    assert_eq!(hash(&["--simd", "scalar"]), expected);
    assert_eq!(hash(&["--threads", "2"]), expected);
    assert_ne!(hash(&["--seed", "2"]), expected);
}

#[test]
fn the_table_says_the_same() {
    let out = good(&["run", "seed_demo", "--steps", "10"]);
    for word in ["bodies       24", "ms per step", "penetration", "ended        moving", "hash"] {
        assert!(out.contains(word), "{word} in {out}");
    }
    // What sleeps overlaps as it did: the weight of nineteen crates presses the lowest one in.
    let out = good(&["run", "stack", "--steps", "300"]);
    assert!(out.contains("ended        at rest, asleep"), "{out}");
    assert!(!out.contains(" 0.000 mm at the end"), "{out}");
}

#[test]
fn unknown_scenes_and_options_are_explained() {
    let error = bad(&["run", "seed_dmeo"]);
    assert!(error.contains("'seed_dmeo'") && error.contains("'seed_demo'"), "{error}");
    assert!(bad(&["run", "no/such/file.json"]).contains("no/such/file.json"));
    assert!(bad(&["run"]).contains("SCENE"));
    assert!(bad(&["run", "seed_demo", "--simd", "mmx"]).contains("avx2"));
    assert!(bad(&["run", "seed_demo", "--steps", "0"]).contains("--steps"));
    assert!(bad(&["run", "seed_demo", "--threads", "many"]).contains("--threads"));
    assert!(bad(&["rendr", "seed_demo"]).contains("'render'"));
    assert!(bad(&["render", "seed_demo", "-o", "out.bmp"]).contains(".png"));
    assert!(bad(&["render", "seed_demo", "-o", "x.png", "--size", "9x9"]).contains("1280x720"));
    assert!(bad(&["render", "seed_demo", "--steps", "1", "-o", "no/dir/x.png"]).contains("no/dir"));
}

#[test]
fn a_broken_scene_file_is_named_with_its_line() {
    let path = scratch("broken.json");
    std::fs::write(&path, "{\n  \"version\": 1,\n  \"name\": 5\n}\n").unwrap();
    let error = bad(&["run", path.to_str().unwrap()]);
    assert!(
        error.contains("broken.json") && error.contains("name") && error.contains('3'),
        "{error}"
    );
}

#[test]
fn pictures_and_animations_are_what_they_should_be() {
    let png = scratch("picture.png");
    good(&[
        "render",
        "seed_demo",
        "--steps",
        "60",
        "-o",
        png.to_str().unwrap(),
        "--size",
        "320x200",
    ]);
    assert!(std::fs::read(&png).unwrap().starts_with(b"\x89PNG"));
    let gif = scratch("film.gif");
    let gif_text = gif.to_str().unwrap();
    let arguments = [
        "render",
        "seed_demo",
        "--steps",
        "20",
        "--every",
        "5",
        "-o",
        gif_text,
        "--size",
        "320x200",
    ];
    assert!(good(&arguments).contains("5 frames"));
    assert!(std::fs::read(&gif).unwrap().starts_with(b"GIF89a"));
    let series = scratch("series.png");
    let series_text = series.to_str().unwrap();
    good(&["render", "seed_demo", "--steps", "4", "--every", "2", "-o", series_text]);
    let dark = scratch("dark.gif");
    let dark_text = dark.to_str().unwrap();
    let few =
        ["render", "harbour", "--from", "10", "--steps", "20", "--every", "5", "--size", "320x200"];
    let few = [&few[..], &["--colors", "16", "--theme", "dark", "-o", dark_text]].concat();
    assert!(good(&few).contains("3 frames"));
    // The header tells the size of the table: 2 to the power of one more than its last three bits.
    assert_eq!(std::fs::read(&dark).unwrap()[10] & 7, 3);
    let debug = scratch("debug.png");
    good(&["render", "stack", "--style", "debug", "--steps", "9", "-o", debug.to_str().unwrap()]);
    for step in [0, 2, 4] {
        assert!(scratch(&format!("series_{step:05}.png")).exists());
    }
}

#[test]
fn parts_of_a_run_are_shown_under_their_names() {
    let series = scratch("part.png");
    let said = good(&[
        "render",
        "seed_demo",
        "--steps",
        "80",
        "--from",
        "60",
        "--every",
        "7",
        "-o",
        series.to_str().unwrap(),
    ]);
    let first = series
        .with_file_name(format!("{}_00060.png", series.file_stem().unwrap().to_str().unwrap()));
    assert!(said.contains(first.to_str().unwrap()) && first.exists(), "{said}");
    // One step is an animation, too; none is refused, and what was there stays.
    let film = scratch("part.gif");
    let film = film.to_str().unwrap();
    good(&["render", "seed_demo", "--steps", "5", "--from", "5", "--size", "64x64", "-o", film]);
    let before = std::fs::read(film).unwrap();
    assert!(before.len() > 100);
    let said = bad(&["render", "seed_demo", "--steps", "5", "--from", "6", "-o", film]);
    assert!(said.contains("--from 6"), "{said}");
    assert_eq!(std::fs::read(film).unwrap(), before);
}

#[test]
fn without_a_display_view_says_so() {
    if cfg!(all(unix, not(target_os = "macos"))) {
        let error = bad(&["view", "seed_demo"]);
        assert!(error.contains("display") && error.contains("render"), "{error}");
    }
}

/// A short soak: twice the same, other seeds other worlds, and every line of the table is there.
#[test]
fn a_soak_ends_in_the_same_state() {
    let soak = |seed: &str| good(&["soak", "--steps", "4000", "--check", "50", "--seed", seed]);
    let hash = |out: &str| out.lines().last().unwrap_or_default().to_owned();
    let (a, b) = (soak("1"), soak("1"));
    assert_eq!(hash(&a), hash(&b));
    assert!(hash(&a).starts_with("hash ") && hash(&a).len() == 21, "{a}");
    assert_ne!(hash(&a), hash(&soak("2")));
    assert!(a.contains("80 checks found all data sound"), "{a}");
    assert_eq!(a.lines().count(), 1 + 20 + 3, "{a}");
    assert!(bad(&["soak", "--steps", "0"]).contains("--steps"));
}

/// Record, replay to a step, compare; what is damaged or of another version is refused with the reason.
#[test]
fn recordings_are_played_again_compared_and_refused() {
    let path = |name: &str| scratch(name).to_str().unwrap().to_owned();
    let record = |name: &str, scene: &[&str]| {
        let file = path(name);
        good(&[&["record"], scene, &["-o", &file]].concat())
    };
    let out = record("a.tpr", &["seed_demo", "--steps", "60"]);
    let (a, b, c) = (path("a.tpr"), path("b.tpr"), path("c.tpr"));
    let last = |out: &str| out.trim_end().rsplit(' ').next().unwrap_or_default().to_owned();
    let played = good(&["replay", &a]);
    assert!(played.starts_with("60 steps with the same bits") && last(&played) == last(&out));
    let seen = good(&["run", "seed_demo", "--steps", "25"]);
    assert_eq!(last(&good(&["replay", &a, "--to", "25"])), last(&seen));

    record("b.tpr", &["seed_demo", "--steps", "60", "--seed", "2"]);
    record("c.tpr", &["seed_demo", "--steps", "40"]);
    assert!(good(&["diff", &a, &a]).contains("alike in all 60 steps"));
    assert!(bad(&["diff", &a, &b]).contains("differ from step 1"));
    assert!(bad(&["diff", &a, &c]).contains("before step 41"));

    // Explosions, water, led platforms, changes of kind and shape, a character.
    for scene in ["character", "harbour", "blast", "changing", "orbits"] {
        let out = record("d.tpr", &[scene, "--steps", "120"]);
        let played = good(&["replay", &path("d.tpr")]);
        assert!(played.starts_with("120 steps with the same bits"), "{played}");
        let seen = good(&["run", scene, "--steps", "120"]);
        assert!(last(&played) == last(&out) && last(&out) == last(&seen), "{scene}");
    }

    let bytes = std::fs::read(&a).unwrap();
    let refusal = |at: usize| {
        let mut other = bytes.clone();
        other[at] ^= 0x40;
        std::fs::write(&b, other).unwrap();
        bad(&["replay", &b])
    };
    let frame = bytes.windows(4).position(|word| word == b"tpw1").expect("a first frame");
    assert!(refusal(frame + 4).contains("another version"));
    assert!(refusal(frame + 30).contains("damaged"));
    assert!(refusal(0).contains("does not begin like a recording"));
    assert!(refusal(3).contains("recording was written by another version"));
    // The end of the file is the hash of the last step.
    assert!(refusal(bytes.len() - 1).contains("first after step 60"));
}

/// The playground and the file are served to this machine; without a playground the program says how to get one.
#[test]
fn the_playground_is_served() {
    use std::io::{BufRead, BufReader, Read, Write};
    use std::process::{Command, Stdio};
    let file = scratch("played.json");
    std::fs::write(&file, "{ \"version\": 1 }").unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_tiny-physics"))
        .args(["play", file.to_str().unwrap()])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut address = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut address).unwrap();
    if address.is_empty() {
        let mut words = String::new();
        child.stderr.take().unwrap().read_to_string(&mut words).unwrap();
        assert!(
            words.contains("without the playground") && words.contains("scripts/web.sh"),
            "{words}"
        );
        assert!(!child.wait().unwrap().success());
        return;
    }
    assert!(address.trim_end().ends_with("/#file=played.json"), "{address}");
    let host = address.trim_start_matches("http://").split('/').next().unwrap().to_owned();
    let get = |path: &str, name: &str| {
        let mut stream = std::net::TcpStream::connect(&host).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\nHost: {name}\r\nConnection: close\r\n\r\n").unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        String::from_utf8_lossy(&answer).into_owned()
    };
    let page = get("/", &host);
    assert!(page.starts_with("HTTP/1.1 200") && page.contains("<canvas id=\"stage\""), "{page}");
    assert!(get("/tiny_physics.wasm", &host).contains("application/wasm"));
    assert!(get("/file", &host).ends_with("{ \"version\": 1 }"));
    assert!(get("/nothing", &host).starts_with("HTTP/1.1 404"));
    assert!(get("/file", "elsewhere.example").starts_with("HTTP/1.1 403"));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(bad(&["play", "no_such_file.json"]).contains("no_such_file.json"));
}

/// Every show scene has its loop in the gallery, small enough for a page of them.
#[test]
fn the_gallery_shows_every_show_scene() {
    let docs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs");
    let page = std::fs::read_to_string(format!("{docs}/gallery.md")).unwrap();
    for entry in all().iter().filter(|entry| entry.has_tag(tags::SHOW)) {
        let file = format!("gallery/{}.gif", entry.name);
        assert!(page.contains(&file), "{} is not in docs/gallery.md", entry.name);
        let size = std::fs::metadata(format!("{docs}/{file}")).unwrap().len();
        assert!(size < 300_000, "{file} has {size} bytes");
    }
}
