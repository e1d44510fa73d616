//! Meshes from files.

mod common;

use std::path::{Path, PathBuf};

use common::Result;
use raywise::{Error, Mesh, Status};

fn file(name: &str, content: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, content).unwrap();
    path
}

const OBJ: &str = "# a roof\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1\nf 1 2 3 4\nf 1 2 5\nf 3 4 5\n";
const OFF: &str = "OFF\n5 3 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 1\n4 0 1 2 3\n3 0 1 4\n3 2 3 4\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                   element face 3\nproperty list uchar int vertex_indices\nend_header\n\
                   0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 1\n4 0 1 2 3\n3 0 1 4\n3 2 3 4\n";

#[test]
fn convex_polygons_are_cut_into_fans_and_remember_their_face() -> Result {
    for path in [file("roof.obj", OBJ), file("roof.off", OFF), file("roof.ply", PLY)] {
        let mesh = Mesh::load(&path)?;
        let name = path.display();
        assert_eq!(mesh.vertices().len(), 5, "{name}");
        assert_eq!(mesh.vertices()[4], [1.0, 1.0, 1.0], "{name}");
        assert_eq!(mesh.indices(), [[0, 1, 2], [0, 2, 3], [0, 1, 4], [2, 3, 4]], "{name}");
        assert_eq!((mesh.triangle_count(), mesh.face_count()), (4, 3), "{name}");
        assert_eq!(mesh.face_of_triangle(), [0, 0, 1, 2], "{name}");
        assert_eq!(mesh.clone().triangles().len(), 4, "{name}");
        assert!(!mesh.is_float64(), "{name}");
    }
    Ok(())
}

#[test]
fn concave_polygons_have_no_surface_outside() -> Result {
    let path = file("dart.off", "OFF\n4 1 0\n0 0 0\n4 -2 0\n0 4 0\n1 0 0\n4 0 1 2 3\n");
    assert_eq!(Mesh::load(path)?.indices(), [[1, 2, 3], [0, 1, 3]]);
    Ok(())
}

#[test]
fn coordinates_are_as_written() -> Result {
    let path = file(
        "utm.obj",
        "v 500000.1 5183526.3 100.25\nv 500000.2 5183526.3 100.25\nv 500000.2 5183526.4 100.25\nf 1 2 3\n",
    );
    let mesh = Mesh::load(path)?;
    assert!(mesh.is_float64());
    assert_eq!(mesh.vertices()[2], [500000.2, 5183526.4, 100.25]);
    Ok(())
}

#[test]
fn stl_files_are_read() -> Result {
    let path = file(
        "corner.stl",
        "solid corner\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
         endsolid corner\n",
    );
    let mesh = Mesh::load(path)?;
    assert_eq!((mesh.triangle_count(), mesh.face_count()), (1, 1));
    let corners: Vec<[f64; 3]> = mesh.indices()[0].iter().map(|&corner| mesh.vertices()[corner as usize]).collect();
    assert_eq!(corners, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    Ok(())
}

#[test]
fn files_that_cannot_be_used_say_why() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for (path, status) in [
        (folder.join("there_is_no_such_file.obj"), Status::FILE_NOT_FOUND),
        (file("mesh.docx", "no mesh"), Status::FILE_FORMAT),
        (file("broken.ply", "ply\nformat nonsense\n"), Status::FILE_FORMAT),
        (file("broken.off", "not an OFF file\n"), Status::FILE_FORMAT),
        (file("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), Status::NO_FACES),
        (file("line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), Status::BAD_POLYGON),
        (file("beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), Status::INDEX_OUT_OF_RANGE),
    ] {
        let error = Mesh::load(&path).unwrap_err();
        assert_eq!(error.status(), Some(status), "{}: {error}", path.display());
        let Error::Library { message, .. } = error else { panic!("{error:?}") };
        assert!(!message.is_empty());
    }
}

#[test]
fn a_folder_is_not_a_mesh() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("folder.obj");
    std::fs::create_dir_all(&folder).unwrap();
    let status = Mesh::load(&folder).unwrap_err().status();
    assert!(matches!(status, Some(Status::FILE_UNREADABLE | Status::FILE_FORMAT)), "{status:?}");
}

#[test]
fn a_path_with_a_zero_is_refused() {
    assert!(matches!(Mesh::load("a\0b.obj"), Err(Error::Text { what: "path", .. })));
}
