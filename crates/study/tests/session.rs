//! A session as a page asks it: its scenes and frames have the numbers of `solve`, its maps those of a sweep.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use hyperstat_study::session::{Answer, Session};
use hyperstat_study::{Disk, Question, Registry, Selection, Study};
use serde_json::{Value, json};

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

/// A session that has loaded an example, with what it said.
fn loaded(name: &str, more: Value) -> (Session, Value) {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(examples()).unwrap() {
        let path = entry.unwrap().path();
        if let Ok(text) = fs::read_to_string(&path) {
            files.insert(
                path.file_name().unwrap().to_string_lossy().into_owned(),
                text,
            );
        }
    }
    let mut request = json!({ "ask": "load", "files": files, "main": name });
    for (field, value) in more.as_object().unwrap() {
        request[field] = value.clone();
    }
    let mut session = Session::default();
    let (value, _) = ask(&mut session, &request);
    (session, value)
}

fn ask(session: &mut Session, request: &Value) -> (Value, Vec<f64>) {
    let Answer { json, numbers } = session.ask(&request.to_string());
    (serde_json::from_str(&json).unwrap(), numbers)
}

fn span<'n>(value: &Value, numbers: &'n [f64]) -> &'n [f64] {
    let [first, length] = [0, 1].map(|k| value[k].as_u64().unwrap() as usize);
    &numbers[first..first + length]
}

fn six(value: &Value) -> [f64; 6] {
    std::array::from_fn(|k| value[k].as_f64().unwrap())
}

/// What the scene has of every node and segment is what `solve --format json` says of it, of every case.
#[test]
fn a_scene_has_the_numbers_of_the_solution() {
    for (name, case) in [
        ("portal.ron", None),
        ("delta.ron", None),
        ("delta_states.ron", None),
        ("tripod.ron", None),
        ("flexible_link.ron", None),
        ("head.ron", Some(0)),
    ] {
        let (mut session, about) = loaded(name, json!({}));
        assert!(about["problem"].is_null(), "{name}: {}", about["problem"]);
        let case = case.and_then(|k: usize| about["cases"].get(k).cloned());
        let mut request = json!({ "ask": "scene" });
        if let Some(case) = &case {
            request["case"] = case.clone();
        }
        let (scene, numbers) = ask(&mut session, &request);
        let (solved, _) = ask(&mut session, &json!({ "ask": "solve" }));
        let state = match &case {
            Some(case) => &solved["cases"][case.as_str().unwrap()],
            None => &solved,
        };
        let count = scene["vertices"].as_u64().unwrap() as usize;
        let layout = &scene["layout"];
        let moved = span(&layout["displacements"], &numbers);
        let positions = span(&layout["positions"], &numbers);
        let stress = span(&layout["stress"], &numbers);
        assert_eq!(
            [moved.len(), positions.len(), stress.len()],
            [6 * count, 3 * count, count]
        );
        for (k, node) in scene["nodes"].as_array().unwrap().iter().enumerate() {
            let own = six(&state["displacements"][node["name"].as_str().unwrap()]);
            assert_eq!(moved[6 * k..6 * k + 6], own, "{name}: {node}");
        }
        let output = scene["output"].as_u64().unwrap() as usize;
        for k in 0..3 {
            let own = solved["output"]["position"][k].as_f64().unwrap();
            assert_eq!(positions[3 * output + k], own, "{name}");
        }
        let segments = scene["segments"].as_array().unwrap();
        for (k, segment) in segments.iter().enumerate() {
            let [first, number] = [0, 1].map(|k| segment["vertices"][k].as_u64().unwrap() as usize);
            for (end, vertex) in [first, first + number - 1].into_iter().enumerate() {
                let node = segment["ends"][end].as_u64().unwrap() as usize;
                let scale = moved.iter().fold(0.0_f64, |size, own| size.max(own.abs()));
                for c in 0..6 {
                    let gap = moved[6 * vertex + c] - moved[6 * node + c];
                    // The curve meets its ends but for rounding.
                    assert!(gap.abs() <= 1e-12 * scale, "{name}: {segment} {gap}");
                }
                for c in 0..3 {
                    assert_eq!(positions[3 * vertex + c], positions[3 * node + c]);
                }
            }
            let told = &state["segments"][k];
            let Some(largest) = told["stress"]["von_mises"].as_f64() else {
                continue;
            };
            let own = stress[first..first + number]
                .iter()
                .copied()
                .fold(0.0, f64::max);
            // Nothing on the curve is larger than the largest that is told.
            assert!(own <= largest * (1.0 + 1e-12), "{name}: {own} {largest}");
            let axes = span(&layout["axes"], &numbers);
            for axis in 0..3 {
                for c in 0..3 {
                    let own = told["axes"][axis][c].as_f64().unwrap();
                    assert_eq!(axes[9 * k + 3 * axis + c], own, "{name}");
                }
            }
        }
        let frames = span(&layout["frames"], &numbers);
        for (k, joint) in scene["joints"].as_array().unwrap().iter().enumerate() {
            let told = &solved["joints"][joint["name"].as_str().unwrap()]["frame"]["axes"];
            for axis in 0..3 {
                for c in 0..3 {
                    assert_eq!(
                        frames[9 * k + 3 * axis + c],
                        told[axis][c].as_f64().unwrap()
                    );
                }
            }
        }
    }
}

/// A frame at a pose tells what `solve`, with why and modes, tells there.
#[test]
fn a_frame_tells_what_solve_tells() {
    let close = |a: &Value, b: &Value, what: &str| {
        let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
        // Both are the numeric pass, whose plan was made in another pose: but for rounding they are the same.
        assert!(
            (a - b).abs() <= 1e-9 * a.abs().max(b.abs()),
            "{what}: {a} {b}"
        );
    };
    for (name, more, pose) in [
        ("maps.ron", json!({}), json!({ "number": 3 })),
        (
            "delta_modes.ron",
            json!({}),
            json!({ "at": { "x": 0.05, "y": -0.02, "z": 0.52 } }),
        ),
        (
            "five_bar.ron",
            json!({}),
            json!({ "at": { "x": 0.02, "y": 0.36 } }),
        ),
    ] {
        let (mut session, about) = loaded(name, more);
        assert!(about["error"].is_null(), "{name}: {about}");
        let (frame, numbers) = ask(&mut session, &json!({ "ask": "frame", "pose": pose }));
        assert_eq!(frame["status"], "ok", "{name}: {frame}");
        let (solved, _) = ask(
            &mut session,
            &json!({ "ask": "solve", "pose": pose, "why": true }),
        );
        assert!(solved["error"].is_null(), "{name}: {}", solved["error"]);
        let output = &solved["output"];
        for k in 0..6 {
            close(&frame["stiffness"][k][k], &output["stiffness"][k][k], name);
        }
        close(&frame["budget"]["total"], &solved["budget"]["total"], name);
        let principal = |of: &Value| of["translational_stiffnesses"]["values"][0].clone();
        close(
            &principal(&frame["principal"]),
            &principal(&solved["measures"]),
            name,
        );
        let (scene, _) = ask(&mut session, &json!({ "ask": "scene", "pose": pose }));
        assert_eq!(frame["layout"], scene["layout"], "{name}");
        assert!(!numbers.is_empty());
        let light = json!({ "ask": "frame", "pose": pose, "light": true });
        let (light, _) = ask(&mut session, &light);
        assert_eq!(light["stiffness"], frame["stiffness"], "{name}");
        assert!(light["budget"].is_null());
        let (placed, _) = ask(&mut session, &json!({ "ask": "place", "pose": pose }));
        assert_eq!(placed["pose"], frame["pose"], "{name}");
        assert_eq!(placed["drives"], frame["drives"], "{name}");
    }
}

/// The drives of a pose that was reached by coordinates lead to the same pose.
#[test]
fn drives_and_coordinates_lead_to_one_pose() {
    let (mut session, about) = loaded("five_bar.ron", json!({}));
    assert_eq!(about["coordinates"].as_array().unwrap().len(), 2, "{about}");
    assert_eq!(about["drives"].as_array().unwrap().len(), 2, "{about}");
    let at = json!({ "ask": "place", "pose": { "at": { "x": 0.02, "y": 0.36 } } });
    let (placed, _) = ask(&mut session, &at);
    assert_eq!(placed["status"], "ok", "{placed}");
    let back = json!({ "ask": "place", "pose": { "drives": placed["drives"] } });
    let (back, _) = ask(&mut session, &back);
    for k in 0..6 {
        let [a, b] = [&placed, &back].map(|own| own["pose"][k].as_f64().unwrap());
        assert!((a - b).abs() < 1e-9, "{placed} {back}");
    }
    let far = json!({ "ask": "frame", "pose": { "at": { "x": 9.0, "y": 0.36 } } });
    let (far, numbers) = ask(&mut session, &far);
    assert_eq!(
        (far["status"].as_str(), numbers.len()),
        (Some("unreachable"), 0)
    );
    assert!(
        far["layout"].is_null() && far["problem"]["message"].is_string(),
        "{far}"
    );
}

/// Some rows of a map at a time are the rows of the whole, and these those of frames.
#[test]
fn a_map_is_that_of_frames() {
    let (mut session, _) = loaded("maps.ron", json!({}));
    let axis = |name: &str| json!({ "name": name, "first": -0.3, "last": 0.3, "count": 7 });
    let request = json!({
        "ask": "sweep", "axes": [axis("x"), axis("y")], "fixed": { "z": 0.5 }, "measure": "k33",
    });
    let (whole, numbers) = ask(&mut session, &request);
    assert_eq!(whole["total"], 49, "{whole}");
    assert_eq!(whole["unit"], "N/m");
    let values = span(&whole["values"], &numbers).to_vec();
    let codes = span(&whole["codes"], &numbers).to_vec();
    let mut parts = Vec::new();
    for rows in [[0, 20], [20, 49]] {
        let mut part = request.clone();
        part["rows"] = json!(rows);
        let (part, numbers) = ask(&mut session, &part);
        parts.extend_from_slice(span(&part["values"], &numbers));
    }
    let bits = |all: &[f64]| all.iter().map(|own| own.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&parts), bits(&values));
    for (row, x, y) in [
        (3 * 7 + 3, 0.0, 0.0),
        (2 * 7 + 4, 0.1, -0.1),
        (0, -0.3, -0.3),
    ] {
        let pose = json!({ "at": { "x": x, "y": y, "z": 0.5 } });
        let (frame, _) = ask(&mut session, &json!({ "ask": "frame", "pose": pose }));
        assert_eq!(
            frame["status"], whole["statuses"][codes[row] as usize],
            "{x} {y}"
        );
        if let Some(own) = frame["stiffness"][2][2].as_f64() {
            assert!(
                (own - values[row]).abs() <= 1e-9 * own,
                "{own} {}",
                values[row]
            );
        } else {
            assert!(values[row].is_nan());
        }
    }
}

/// A value is set by the path that is told, and taken back by none.
#[test]
fn values_are_set_and_taken_back() {
    let (mut session, about) = loaded("portal.ron", json!({}));
    let (values, _) = ask(&mut session, &json!({ "ask": "values" }));
    let named = |path: &str| {
        let all = values.as_array().unwrap();
        let found = all.iter().find(|own| own["path"] == path);
        found
            .unwrap_or_else(|| panic!("no {path}: {values}"))
            .clone()
    };
    let diameter = named("sections.rod.diameter");
    assert_eq!(
        (&diameter["value"], &diameter["unit"]),
        (&json!(0.014), &json!("m"))
    );
    assert_eq!(diameter["parts"], json!(["arm"]));
    assert_eq!(named("materials.steel.young")["unit"], "Pa");
    assert_eq!(named("points.B.1")["unit"], "m");
    let stiffness = named("joints.wrist.stiffness.x");
    assert_eq!(
        (&stiffness["unit"], &stiffness["parts"]),
        (&json!("N/m"), &json!(["joint wrist"]))
    );
    let sag = |session: &mut Session| {
        let (frame, _) = ask(session, &json!({ "ask": "frame" }));
        frame["deflection"].as_f64().unwrap()
    };
    let before = sag(&mut session);
    let thicker = json!({ "ask": "set", "values": [["sections.rod.diameter", 0.028]] });
    let (set, _) = ask(&mut session, &thicker);
    assert!(set["error"].is_null(), "{set}");
    let ratio = before / sag(&mut session);
    assert!((10.0..16.1).contains(&ratio), "{ratio}");
    let wrong = json!({ "ask": "set", "values": [["sections.rod.diameter", -1.0]] });
    let (wrong, _) = ask(&mut session, &wrong);
    assert_eq!(wrong["error"]["code"], "input", "{wrong}");
    let (back, _) = ask(&mut session, &json!({ "ask": "set", "values": [] }));
    assert_eq!(back, about);
    assert_eq!(sag(&mut session).to_bits(), before.to_bits());
}

/// What is wrong is told with its place, and what was loaded stays.
#[test]
fn what_is_refused_has_its_place() {
    let mut session = Session::default();
    let (early, _) = ask(&mut session, &json!({ "ask": "frame" }));
    assert_eq!(early["error"]["code"], "nothing-loaded");
    let text = fs::read_to_string(examples().join("portal.ron")).unwrap();
    let load = |text: &str| json!({ "ask": "load", "files": { "a.ron": text }, "main": "a.ron" });
    ask(&mut session, &load(&text));
    let (wrong, _) = ask(&mut session, &load(&text.replace("young", "youg")));
    let error = &wrong["error"];
    assert_eq!(
        (&error["code"], &error["path"]),
        (&json!("input"), &json!("a.ron"))
    );
    let line = error["line"].as_u64().unwrap() as usize;
    let column = error["column"].as_u64().unwrap() as usize;
    let length = error["length"].as_u64().unwrap() as usize;
    let own = text.replace("young", "youg");
    let meant = &own.lines().nth(line - 1).unwrap()[column - 1..column - 1 + length];
    assert_eq!(meant, "youg", "{error}");
    // A mechanism that nothing holds is loaded, drawn, and told of.
    let (free, _) = ask(&mut session, &load(&text.replace(", locked: true", "")));
    assert!(
        free["error"].is_null() && free["problem"]["line"].is_u64(),
        "{free}"
    );
    let (scene, numbers) = ask(&mut session, &json!({ "ask": "scene" }));
    assert_eq!(scene["status"], "unrestrained", "{}", scene["problem"]);
    assert!(!span(&scene["layout"]["positions"], &numbers).is_empty());
    let (frame, _) = ask(&mut session, &json!({ "ask": "frame" }));
    assert_eq!(frame["status"], "unrestrained", "{frame}");
    for nonsense in ["", "{}", "{\"ask\": \"dance\"}", "[1]"] {
        let answer = session.ask(nonsense);
        assert!(
            answer.json.contains("\"code\":\"request\""),
            "{}",
            answer.json
        );
    }
}

/// Every example is loaded, drawn and solved as the study does it.
#[test]
fn every_example_is_drawn() {
    let registry = Registry::builtin();
    for entry in fs::read_dir(examples()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "ron") {
            continue;
        }
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let (mut session, about) = loaded(&name, json!({}));
        assert!(about["error"].is_null(), "{name}: {about}");
        let selection = Selection {
            job: about["job"].as_str().map(Into::into),
            design: None,
            pose: about["pose"].as_u64().map(|pose| pose as usize),
        };
        let mut study = Study::open(&path, &selection, &Disk, &registry).unwrap();
        let report = study.answer(&Question::default()).unwrap().report;
        let (solved, _) = ask(&mut session, &json!({ "ask": "solve" }));
        assert_eq!(solved, json!(report), "{name}");
        for request in ["scene", "frame", "values"] {
            let (value, _) = ask(&mut session, &json!({ "ask": request }));
            assert!(value["error"].is_null(), "{name}: {request}: {value}");
            assert!(
                value["problem"].is_null(),
                "{name}: {request}: {}",
                value["problem"]
            );
        }
    }
}
