//! The command line of the generator; `bindings/generate.py` is what people call.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use raywise_generator::{circle, declarations, Failure};

const USAGE: &str = "usage:
  raywise-generator declarations HEADER OUTPUT     write the Rust declarations of HEADER to OUTPUT
  raywise-generator circle HEADER DECLARATIONS RETURNED
                                                   turn DECLARATIONS back into the header RETURNED and compare it with HEADER";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match arguments[..] {
        ["declarations", header, output] => write_declarations(Path::new(header), Path::new(output)),
        ["circle", header, declarations, returned] => {
            close_circle(Path::new(header), Path::new(declarations), PathBuf::from(returned))
        }
        _ => Err(USAGE.into()),
    };
    match outcome {
        Ok(code) => code,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::from(2)
        }
    }
}

fn write_declarations(header: &Path, output: &Path) -> Result<ExitCode, Failure> {
    std::fs::write(output, declarations::generate(header)?)?;
    Ok(ExitCode::SUCCESS)
}

fn close_circle(header: &Path, declarations: &Path, returned: PathBuf) -> Result<ExitCode, Failure> {
    let rust = std::fs::read_to_string(declarations)?;
    let report = circle::compare(header, &rust, &returned)?;
    for difference in &report.differences {
        println!("{difference}");
    }
    println!(
        "circle: {} structs, {} handles, {} callbacks, {} functions, {} constants; {} differences",
        report.structs,
        report.handles,
        report.callbacks,
        report.functions,
        report.constants,
        report.differences.len()
    );
    Ok(if report.differences.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
