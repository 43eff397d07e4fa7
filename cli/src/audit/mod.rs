//! `impact-pair audit SCENE EVENTS`: another simulator's list of impacts, compared with the certified orbit.

pub mod arguments;
mod table;

use anyhow::{Context, Error, Result, anyhow, bail};
use impact_pair::audit::{Audit, read};
use impact_pair::json::one_a_line;
use impact_pair::{ErrorKind, Scene};

use crate::Answer;
use crate::progress::Progress;
use crate::scene;
use arguments::{AuditArguments, AuditFormat};

pub fn audit(arguments: &AuditArguments) -> Result<Answer> {
    if arguments.scene.as_os_str() == "-" && arguments.events.as_os_str() == "-" {
        bail!("scene and events are both -, but stdin can only be one of them");
    }
    let format = arguments.destination.format(arguments.format)?;
    let scene = scene::read(&arguments.scene).map_err(|error| {
        let is_scene = |path| scene::text(path).is_ok_and(|text| Scene::parse(&text).is_ok());
        match !scene::is_stdio(&arguments.events) && is_scene(&arguments.events) {
            true => {
                let [events, scene] = [&arguments.scene, &arguments.events].map(|path| scene::name(path));
                anyhow!("{events} is not a scene, but {scene} is one: did you mean impact-pair audit {scene} {events}?")
            }
            false => error,
        }
    })?;
    let named = || scene::name(&arguments.events);
    let text = scene::text(&arguments.events)?;
    let list = read(&text, &arguments.columns(), scene.pair()).with_context(named)?;
    let files = arguments.destination.open(&[&arguments.scene, &arguments.events], None)?;
    let progress = Progress::new(Some(list.rows.len() as u64), !files.quiet);
    let audit = Audit::of(&scene, list, &arguments.audit_settings(), &progress).map_err(|error| match error.key() {
        Some("until") => anyhow!("--{error}"),
        _ if error.kind() == ErrorKind::List => Error::from(error).context(named()),
        _ => Error::from(error).context(scene::name(&arguments.scene)),
    })?;
    progress.clear();

    let text = match format {
        AuditFormat::Table => table::table(&audit, &named(), arguments.all),
        AuditFormat::Json => format!("{}\n", one_a_line(&audit.document(), &["events"])),
    };
    let open = (!audit.is_agreed()).then(|| audit.advice());
    files.answer(&text, open, format == AuditFormat::Table)
}
