//! Options in JSON, read as on the command line.

use std::collections::BTreeMap;
use std::error::Error as _;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, ArgAction, Args, Command};
use impact_pair::Error;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_json::value::RawValue;

use crate::Failure;

/// Options with their values. A number has the digits that are written: no double stands between.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Options(BTreeMap<String, Box<RawValue>>);

/// Reads options by the arguments of the command line: both have one syntax, one range of values and one refusal.
///
/// # Errors
/// If an option is unknown, missing or not accepted.
pub fn read_options<O: Args>(verb: &'static str, options: &Options) -> Result<O, Failure> {
    let bare = Command::new(verb).no_binary_name(true).disable_help_flag(true).disable_version_flag(true);
    let command = O::augment_args(bare);
    let mut words = Vec::new();
    let mut positional = Vec::new();
    for (name, written) in &options.0 {
        let known = command.get_arguments().find(|argument| name_of(argument) == *name);
        let argument = known.ok_or_else(|| unknown(&command, name))?;
        let is_switch = matches!(argument.get_action(), ArgAction::SetTrue);
        let value: Value = serde_json::from_str(written.get()).map_err(Failure::malformed)?;
        let typed = value.as_str().unwrap_or(written.get());
        match value {
            Value::Null | Value::Bool(false) if is_switch || value.is_null() => {}
            Value::Bool(true) if is_switch => words.push(format!("--{name}")),
            _ if is_switch || value.is_boolean() => {
                let accepted = if is_switch { "accepted is true or false" } else { "accepted is a number or a text" };
                return Err(refused(name, written.get(), accepted));
            }
            Value::Array(_) if matches!(argument.get_action(), ArgAction::Append) => {
                let each: Vec<Box<RawValue>> = serde_json::from_str(written.get()).map_err(Failure::malformed)?;
                for one in each {
                    let value: Value = serde_json::from_str(one.get()).map_err(Failure::malformed)?;
                    words.push(format!("--{name}={}", value.as_str().unwrap_or(one.get())));
                }
            }
            _ if argument.is_positional() => positional.push(typed.to_owned()),
            _ => words.push(format!("--{name}={typed}")),
        }
    }
    if !positional.is_empty() {
        words.push("--".to_owned());
    }
    let matches = command.try_get_matches_from(words.into_iter().chain(positional)).map_err(|error| failure(&error))?;
    O::from_arg_matches(&matches).map_err(|error| failure(&error))
}

/// The name of an argument in JSON: that of its option, or of the place of a positional one.
fn name_of(argument: &Arg) -> String {
    argument.get_long().map_or_else(|| argument.get_id().to_string(), str::to_owned)
}

fn refused(option: &str, value: &str, accepted: &str) -> Failure {
    Failure::Value { option: option.to_owned(), value: value.to_owned(), accepted: accepted.to_owned() }
}

fn unknown(command: &Command, name: &str) -> Failure {
    let names: Vec<String> = command.get_arguments().map(name_of).collect();
    let verb = command.get_name();
    Failure::malformed(format!("{name} is not an option of {verb}: accepted are {}", names.join(", ")))
}

/// The refusal of the parser of the command line, in terms of options and values.
fn failure(error: &clap::Error) -> Failure {
    let named = |kind| match error.get(kind) {
        Some(ContextValue::String(one)) => one.clone(),
        Some(ContextValue::Strings(all)) => all.join(", "),
        _ => String::new(),
    };
    // `--words <N>`
    let argument = named(ContextKind::InvalidArg);
    let option = argument.trim_start_matches("--").split([' ', '=']).next().unwrap_or_default().to_owned();
    let value = named(ContextKind::InvalidValue);
    match error.kind() {
        ErrorKind::MissingRequiredArgument => Failure::malformed(format!("{option} is missing")),
        ErrorKind::ArgumentConflict => {
            let other = named(ContextKind::PriorArg);
            let other = other.trim_start_matches("--").split(' ').next().unwrap_or_default().to_owned();
            Failure::malformed(format!("{option} and {other} exclude one another"))
        }
        ErrorKind::InvalidValue => refused(&option, &value, &format!("accepted is {}", named(ContextKind::ValidValue))),
        _ => match error.source() {
            Some(source) => match source.downcast_ref::<Error>() {
                Some(error) => Failure::Option { option, value, error: Box::new(error.clone()) },
                None => refused(&option, &value, &source.to_string()),
            },
            None => Failure::malformed(error),
        },
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::read_options;
    use crate::{BifurcationOptions, Failure, PeriodicOptions, TwoImpactOptions, Verb};

    fn options<V: Verb>(options: &Value) -> Result<V, Failure> {
        read_options(V::NAME, &serde_json::from_str(&options.to_string()).unwrap())
    }

    fn refusal<V: Verb + std::fmt::Debug>(given: Value) -> String {
        options::<V>(&given).unwrap_err().to_string()
    }

    #[test]
    fn options_are_numbers_texts_or_switches() {
        let found: PeriodicOptions = options(&json!({"word": "RL", "cycles": "3", "all": true, "digits": 12})).unwrap();
        assert_eq!((found.cycles, found.all, found.word.to_string().as_str()), (3, true, "P2 P1"));
        let usual: PeriodicOptions =
            options(&json!({"word": "RL", "cycles": 1, "all": false, "digits": null})).unwrap();
        assert!(!usual.all);
        let found: TwoImpactOptions = options(&json!({"cycles": "1..3", "wall": "right"})).unwrap();
        assert_eq!(found.cycles, 1..=3);
    }

    #[test]
    fn a_refusal_names_the_option_its_value_and_what_is_accepted() {
        let given = json!({"word": "RL", "cycles": 0});
        let accepted = "cycles is 0, but accepted is a whole number from 1 to 1000000";
        assert_eq!(refusal::<PeriodicOptions>(given), accepted);
        assert_eq!(refusal::<PeriodicOptions>(json!({"cycles": 1})), "word is missing");
        let unknown = "wrod is not an option of periodic: accepted are word, cycles, all, max-bits, no-witness, digits";
        assert_eq!(refusal::<PeriodicOptions>(json!({"wrod": "RL"})), unknown);
        let given = json!({"word": "RL", "cycles": 1, "all": "yes"});
        assert_eq!(refusal::<PeriodicOptions>(given), "all is \"yes\", but accepted is true or false");
        assert_eq!(refusal::<TwoImpactOptions>(json!({"wall": "up"})), "wall is up, but accepted is left, right");
        let given = json!({"solve-for": "gap", "manifold": "frequency=1..2:3"});
        assert_eq!(refusal::<TwoImpactOptions>(given), "manifold and solve-for exclude one another");
        let word = options::<PeriodicOptions>(&json!({"word": "rl", "cycles": 1})).unwrap_err();
        assert!(matches!(word, Failure::Option { option, value, .. } if option == "word" && value == "rl"));
        // Neither files nor anything else of the command line can be reached.
        assert!(refusal::<BifurcationOptions>(json!({"output": "x.json"})).starts_with("output is not an option"));
    }
}
