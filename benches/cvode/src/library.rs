//! The functions of an installed SUNDIALS.

use std::{
    ffi::{CStr, CString, c_char, c_int, c_long, c_void},
    mem::transmute_copy,
    path::Path,
};

/// `sunindextype` as SUNDIALS is built by default.
pub(crate) type Index = i64;
/// Any of its objects.
pub(crate) type Object = *mut c_void;
/// `CVRhsFn`.
pub(crate) type Rates = extern "C" fn(f64, Object, Object, Object) -> c_int;
/// `CVLsJacFn`.
pub(crate) type Jacobian =
    extern "C" fn(f64, Object, Object, Object, Object, Object, Object, Object) -> c_int;

macro_rules! functions {
    ($($name:ident = $symbol:literal: fn($($argument:ty),*) -> $result:ty;)*) => {
        /// The functions by what they are called here. Each must be called as its documentation says.
        #[derive(Debug, Clone, Copy)]
        pub(crate) struct Functions {
            $(pub(crate) $name: unsafe extern "C" fn($($argument),*) -> $result,)*
        }

        impl Functions {
            fn of(library: Object) -> Result<Self, String> {
                // SAFETY: the signatures are those of SUNDIALS 7 with 64-bit indices and doubles.
                Ok(unsafe { Self { $($name: function(library, $symbol)?,)* } })
            }
        }
    };
}

functions! {
    version = c"SUNDIALSGetVersionNumber": fn(*mut c_int, *mut c_int, *mut c_int, *mut c_char, c_int) -> c_int;
    new_context = c"SUNContext_Create": fn(c_int, *mut Object) -> c_int;
    free_context = c"SUNContext_Free": fn(*mut Object) -> c_int;
    new_vector = c"N_VNew_Serial": fn(Index, Object) -> Object;
    numbers = c"N_VGetArrayPointer": fn(Object) -> *mut f64;
    free_vector = c"N_VDestroy": fn(Object) -> ();
    new_band = c"SUNBandMatrix": fn(Index, Index, Index, Object) -> Object;
    column = c"SUNBandMatrix_Column": fn(Object, Index) -> *mut f64;
    free_matrix = c"SUNMatDestroy": fn(Object) -> ();
    new_solver = c"SUNLinSol_Band": fn(Object, Object, Object) -> Object;
    free_solver = c"SUNLinSolFree": fn(Object) -> c_int;
    create = c"CVodeCreate": fn(c_int, Object) -> Object;
    free = c"CVodeFree": fn(*mut Object) -> ();
    init = c"CVodeInit": fn(Object, Rates, f64, Object) -> c_int;
    tolerances = c"CVodeSStolerances": fn(Object, f64, f64) -> c_int;
    set_data = c"CVodeSetUserData": fn(Object, Object) -> c_int;
    set_steps = c"CVodeSetMaxNumSteps": fn(Object, c_long) -> c_int;
    set_stop = c"CVodeSetStopTime": fn(Object, f64) -> c_int;
    set_solver = c"CVodeSetLinearSolver": fn(Object, Object, Object) -> c_int;
    set_jacobian = c"CVodeSetJacFn": fn(Object, Jacobian) -> c_int;
    advance = c"CVode": fn(Object, f64, Object, *mut f64, c_int) -> c_int;
    interpolate = c"CVodeGetDky": fn(Object, f64, c_int, Object) -> c_int;
}

/// The function of this name.
///
/// # Safety
///
/// `F` must be the type of a function pointer with its signature.
unsafe fn function<F>(library: Object, name: &CStr) -> Result<F, String> {
    let address = address(library, name);
    if address.is_null() {
        return Err(format!("it has no {}", name.to_string_lossy()));
    }
    // SAFETY: both are pointers of the same size, and the caller answers for the signature.
    Ok(unsafe { transmute_copy(&address) })
}

#[cfg(unix)]
fn address(library: Object, name: &CStr) -> Object {
    // SAFETY: the library stays open, and the name is a C string.
    unsafe { libc::dlsym(library, name.as_ptr()) }
}

#[cfg(unix)]
fn load(name: &CStr) -> Object {
    // SAFETY: the name is a C string; what the library does when it is opened is up to whoever names it.
    unsafe { libc::dlopen(name.as_ptr(), libc::RTLD_NOW | libc::RTLD_LOCAL) }
}

/// Elsewhere no library is opened.
#[cfg(not(unix))]
fn address(_library: Object, _name: &CStr) -> Object {
    std::ptr::null_mut()
}

#[cfg(not(unix))]
fn load(_name: &CStr) -> Object {
    std::ptr::null_mut()
}

/// Opens the library, which is never closed.
pub(crate) fn open(path: &Path) -> Result<Functions, String> {
    let name =
        CString::new(path.as_os_str().as_encoded_bytes()).map_err(|fault| fault.to_string())?;
    let library = load(&name);
    if library.is_null() {
        return Err("it cannot be opened".to_owned());
    }
    let functions = Functions::of(library)?;
    let (mut major, mut minor, mut patch, mut label) = (0, 0, 0, [0; 32]);
    // SAFETY: all places are there, and the label's length is told.
    unsafe {
        (functions.version)(&raw mut major, &raw mut minor, &raw mut patch, label.as_mut_ptr(), 32)
    };
    if major == 7 { Ok(functions) } else { Err(format!("it is version {major}, not 7")) }
}
