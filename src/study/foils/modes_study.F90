#include "gfb_petsc.h"
!> Natural modes of a foil or a component of it.
module gfb_modes_study
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_petsc_session, only: largest_over_ranks
  use gfb_scene, only: scene_type
  use gfb_modes_case, only: part_strip
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure
  use gfb_foil_assembly, only: assemble_mass
  use gfb_foil_builder, only: foil_plan_type
  use gfb_part_builder, only: build_part
  use gfb_foil_plan, only: plan_foil
  use gfb_eigenmodes, only: modes_type, lowest_modes, destroy_modes
  use gfb_free_motions, only: free_motions
  use gfb_mode_energies, only: sharpen_modes
  use gfb_reasons, only: reason_few_modes
  use gfb_run_context, only: run_context_type
  use gfb_study, only: study_type
  use gfb_reduced_modes, only: reduce_strip
  use gfb_modes_writing, only: modes_result_type, write_modes, rigid
  implicit none (type)
  private

  !> The component that vibrates, and its modes.
  type, extends(study_type), public :: modes_study_type
    private
    type(foil_plan_type) :: plan
    type(foil_structure_type) :: component
    type(modes_result_type) :: result
  contains
    procedure :: prepare => prepare_modes
    procedure :: solve => solve_modes
    procedure :: write => write_study
    procedure :: discard => discard_modes
  end type modes_study_type

contains

  !> Plans the component.
  subroutine prepare_modes(self, scene, log)
    class(modes_study_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go

    call plan_foil(scene, log, self%plan)
    self%memory = self%plan%memory
  end subroutine prepare_modes

  !> Finds the modes, and those of a strip's reduced matrices.
  !>
  !> Fails when the mesh cannot be made or an eigenvalue solver fails.
  subroutine solve_modes(self, scene, context, error)
    class(modes_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(modes_type) :: motions
    Mat :: mass
    PetscErrorCode :: ierr
    integer :: found

    associate (component => self%component, modes => self%result%modes, shift => self%result%shift)
      call build_part(scene, self%plan, component, error)
      if (allocated(error)) return
      call assemble_mass(component, mass, error)
      if (allocated(error)) return
      shift = plate_eigenvalue(component)
      call free_motions(component, mass, motions)
      call lowest_modes(component%stiffness, mass, shift, scene%modes%count, modes, motions)
      call destroy_modes(motions)
      call sharpen_modes(component, mass, rigid*shift, modes, self%result%lost, self%result%left, error)
      PetscCallA(MatDestroy(mass, ierr))
      if (allocated(error)) return
      found = size(modes%eigenvalue)
      self%converged = found >= min(scene%modes%count, component%unknowns)
      if (.not. self%converged) then
        self%reason%code = reason_few_modes
        self%reason%at = found
        call context%log%tell(self%reason%words())
      end if
      allocate (self%result%arrays(0), self%result%reduced(0))
      if (scene%modes%part == part_strip) then
        call reduce_strip(component, scene%modes%substructure_modes, found, shift, context%log, self%result%arrays, &
                          self%result%reduced, error)
      end if
    end associate
  end subroutine solve_modes

  !> Writes the result files.
  !>
  !> Fails when one cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(modes_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed

    self%result%converged = self%converged
    call write_modes(scene, context, self%component, self%result, summary, error)
  end subroutine write_study

  !> Frees what the solvers hold.
  subroutine discard_modes(self)
    class(modes_study_type), intent(inout) :: self !! the study

    call destroy_modes(self%result%modes)
    call destroy_foil_structure(self%component)
  end subroutine discard_modes

  !> Size of the lowest eigenvalue: that of a free plate as long as the mesh [1/s2].
  function plate_eigenvalue(component) result(eigenvalue)
    type(foil_structure_type), intent(in) :: component
    real(wp) :: eigenvalue
    real(wp) :: length, ends(4)

    associate (x => component%mesh%position(1, :), z => component%mesh%position(3, :), foil => component%section)
      ends = largest_over_ranks([maxval(x), -minval(x), maxval(z), -minval(z)])
      length = max(ends(1) + ends(2), ends(3) + ends(4))
      eigenvalue = foil%youngs_modulus*foil%thickness**2/(12.0_wp*(1.0_wp - foil%poissons_ratio**2)* &
                                                          foil%density*length**4)
    end associate
  end function plate_eigenvalue
end module gfb_modes_study
