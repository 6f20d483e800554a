#include "gfb_petsc.h"
!> Natural modes of a foil or a component of it.
module gfb_modes_study
  use petscmat
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_result_names, only: add_result
  use gfb_result_table, only: all_modes_found, of_shifted_stiffness
  use gfb_petsc_session, only: wall_time, sum_over_ranks, rank_count, largest_over_ranks
  use gfb_c_library, only: peak_memory
  use gfb_scene, only: scene_type
  use gfb_study_cases, only: part_words, part_top_foil, part_strip
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure
  use gfb_eigenmodes, only: modes_type, lowest_modes, destroy_modes
  use gfb_mode_energies, only: exact, sharpen_modes
  use gfb_free_motions, only: free_motions
  use gfb_case_file, only: history_row_type, case_array_type, fill_array
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_foil_grid, only: create_foil_grid, add_displacement
  use gfb_provenance, only: blas_in_use
  use gfb_run_context, only: run_context_type
  use gfb_craig_bampton, only: craig_bampton_type, craig_bampton, assembled_eigenvalues
  use gfb_foil_assembly, only: assemble_mass
  use gfb_foil_builder, only: foil_plan_type
  use gfb_part_builder, only: build_part
  use gfb_foil_plan, only: plan_foil
  use gfb_outcome, only: add_outcome
  use gfb_reasons, only: reason_few_modes
  use gfb_study, only: study_type
  implicit none (type)
  private

  real(wp), parameter :: rigid = 1.0e-3_wp !! eigenvalues below this share of the plate's are rigid [1]

  !> The component that vibrates, and its modes.
  type, extends(study_type), public :: modes_study_type
    private
    type(foil_plan_type) :: plan
    type(foil_structure_type) :: component
    type(modes_type) :: modes
    real(wp) :: shift = 0.0_wp                      !! size of the lowest eigenvalue [1/s2]
    real(wp) :: lost = 0.0_wp, left = 0.0_wp        !! digits of eigenvalues, as `sharpen_modes` has it [1]
    type(case_array_type), allocatable :: arrays(:) !! matrices of the reduced strip
    type(quantity_type), allocatable :: reduced(:)  !! its frequencies
  contains
    procedure :: prepare => prepare_modes, solve => solve_modes, write => write_study
    procedure :: discard => discard_modes
  end type modes_study_type

contains

  !> Shows the modes and writes the result files.
  !>
  !> Fails when one cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(modes_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(quantity_type), allocatable :: list(:)
    type(history_row_type) :: history(1)
    type(result_grid_type) :: grid
    real(wp) :: memory(1)
    integer :: i

    associate (log => context%log, eigenvalue => self%modes%eigenvalue)
      call log%heading('answer')
      do i = 1, size(eigenvalue)
        call log%line('mode '//text(i)//'  '//text(hertz(eigenvalue(i)), 6)//' Hz')
      end do
      call log%line(trim(part_words(scene%modes%part))//' of '//text(self%component%unknowns)//' unknowns, '// &
                    text(rank_count())//' rank(s), BLAS '//blas_in_use())
      if (self%lost > exact) call warn_of_round_off(log, self%lost, self%left, scene%modes%part == part_strip)
      call draw_modes(scene, self%component, self%modes, grid)
      call add_result(list, 'analysis', 'modes')
      call add_result(list, 'converged', self%converged, all_modes_found)
      do i = 1, size(eigenvalue)
        call add_result(list, 'frequency_'//text(i), hertz(eigenvalue(i)))
      end do
      call add_result(list, 'rigid_modes', count(abs(eigenvalue) < rigid*self%shift))
      if (self%lost > exact) call add_result(list, 'frequency_round_off', self%left)
      memory = sum_over_ranks([peak_memory()])
      call add_result(list, 'unknowns', self%component%unknowns)
      call add_result(list, 'factorizations', 1, of_shifted_stiffness)
      call add_result(list, 'wall_time', wall_time() - context%start_time)
      call add_result(list, 'peak_memory', memory(1))
      history(1)%quantity = list
      call add_quantity(summary, list)
      call add_quantity(summary, self%reduced)
      call add_outcome(summary, self%converged, self%reason)
      call write_result_set(scene, context%folder, self%converged, context%origin(), summary, history, &
                            self%arrays, [grid], context%csv, log, error)
    end associate
  end subroutine write_study

  !> Frequency of an eigenvalue; one that rounding has made negative has none.
  elemental function hertz(eigenvalue) result(frequency)
    real(wp), intent(in) :: eigenvalue !! [1/s2]
    real(wp) :: frequency !! [Hz]
    frequency = sqrt(max(eigenvalue, 0.0_wp))/turn
  end function hertz

  !> The shapes of the modes as fields of a surface.
  subroutine draw_modes(scene, component, modes, grid)
    type(scene_type), intent(in) :: scene
    type(foil_structure_type), intent(in) :: component
    type(modes_type), intent(in) :: modes
    type(result_grid_type), intent(out) :: grid
    real(wp), allocatable :: moved(:, :)
    integer :: i

    call create_foil_grid(component, trim(merge('top_foil ', 'bump_foil', scene%modes%part == part_top_foil)), grid)
    allocate (moved(node_unknowns, size(component%part%mesh_node)))
    do i = 1, size(modes%shape)
      call component%displacements(modes%shape(i), moved)
      call add_displacement(component, 'mode_'//text(i), 'shape of unit modal mass', moved, grid)
    end do
  end subroutine draw_modes

  !> Says where the matrix had lost digits.
  subroutine warn_of_round_off(log, lost, left, reduced)
    type(run_log_type), intent(in) :: log
    real(wp), intent(in) :: lost, left !! of the eigenvalues [1]
    logical, intent(in) :: reduced     !! there is a reduced strip too

    call log%warning('the foil is so thin that round-off of its stretching stiffness moves frequencies by up to '// &
                     text(0.5_wp*lost, 2)//' of themselves; the energies of strains put them right, to about '// &
                     text(left, 2))
    if (reduced) call log%warning('the Craig-Bampton matrices and frequencies keep that round-off')
  end subroutine warn_of_round_off

  !> Condenses every super-element of a strip, with some of its fixed-interface modes.
  !>
  !> Fails where a super-element cannot be factorized.
  subroutine reduce_strip(strip, modes_kept, wanted, shift, log, arrays, frequencies, error)
    type(foil_structure_type), intent(in) :: strip !! that vibrates
    integer, intent(in) :: modes_kept !! of every super-element
    integer, intent(in) :: wanted     !! frequencies
    real(wp), intent(in) :: shift     !! [1/s2]
    type(run_log_type), intent(in) :: log !! where lines go
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! their matrices
    type(quantity_type), allocatable, intent(inout) :: frequencies(:) !! of the reduced strip
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(craig_bampton_type), allocatable :: kinds(:)
    real(wp), allocatable :: eigenvalue(:)
    integer :: i

    call craig_bampton(strip, modes_kept, kinds, error)
    if (allocated(error)) return
    eigenvalue = assembled_eigenvalues(strip, kinds, shift, wanted)
    call list_matrices(strip, kinds, arrays)
    do i = 1, size(eigenvalue)
      call add_result(frequencies, 'craig_bampton_frequency_'//text(i), hertz(eigenvalue(i)))
    end do
    call log%line('Craig-Bampton: '//text(size(kinds))//' kinds of super-element with '//text(modes_kept)// &
                  ' modes each, written to /craig_bampton')
  end subroutine reduce_strip

  !> The matrices of every kind, each on the rank that computed it, for the result file.
  subroutine list_matrices(strip, kinds, arrays)
    type(foil_structure_type), intent(in) :: strip
    type(craig_bampton_type), intent(inout) :: kinds(:) !! the matrices leave them
    type(case_array_type), allocatable, intent(out) :: arrays(:)
    integer :: i

    allocate (arrays(2*size(kinds) + 1))
    do i = 1, size(kinds)
      call add_matrix('stiffness', kinds(i)%stiffness, arrays(2*i - 1))
      call add_matrix('mass', kinds(i)%mass, arrays(2*i))
    end do
    call fill_array('/craig_bampton/kind_of_substructure', '1', 'kind of each super-element, from the smallest x on', &
                    reshape(real(strip%substructure%kind, wp), [1, size(strip%substructure)]), arrays(size(arrays)))

  contains

    !> One matrix of a kind.
    subroutine add_matrix(name, matrix, array)
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(inout) :: matrix(:, :)
      type(case_array_type), intent(inout) :: array

      array%path = '/craig_bampton/kind_'//text(i)//'/'//name
      array%unit = 'mixed SI'
      array%meaning = 'retained unknowns, then modes'
      array%rows = kinds(i)%retained + kinds(i)%modes
      if (kinds(i)%mine) then
        call move_alloc(matrix, array%values)
      else
        allocate (array%values(array%rows, 0))
      end if
    end subroutine add_matrix
  end subroutine list_matrices

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

    associate (component => self%component, modes => self%modes, shift => self%shift)
      call build_part(scene, self%plan, component, error)
      if (allocated(error)) return
      call assemble_mass(component, mass, error)
      if (allocated(error)) return
      shift = plate_eigenvalue(component)
      call free_motions(component, mass, motions)
      call lowest_modes(component%stiffness, mass, shift, scene%modes%count, modes, motions)
      call destroy_modes(motions)
      call sharpen_modes(component, mass, rigid*shift, modes, self%lost, self%left, error)
      PetscCallA(MatDestroy(mass, ierr))
      if (allocated(error)) return
      found = size(modes%eigenvalue)
      self%converged = found >= min(scene%modes%count, component%unknowns)
      if (.not. self%converged) then
        self%reason%code = reason_few_modes
        self%reason%at = found
        call context%log%tell(self%reason%words())
      end if
      allocate (self%arrays(0), self%reduced(0))
      if (scene%modes%part == part_strip) then
        call reduce_strip(component, scene%modes%substructure_modes, found, shift, context%log, self%arrays, &
                          self%reduced, error)
      end if
    end associate
  end subroutine solve_modes

  !> Frees what the solvers hold.
  subroutine discard_modes(self)
    class(modes_study_type), intent(inout) :: self !! the study

    call destroy_modes(self%modes)
    call destroy_foil_structure(self%component)
  end subroutine discard_modes

  !> Size of the lowest eigenvalue: that of a free plate as long as the mesh [1/s2].
  real(wp) function plate_eigenvalue(component) result(eigenvalue)
    type(foil_structure_type), intent(in) :: component
    real(wp) :: length, ends(4)

    associate (x => component%mesh%position(1, :), z => component%mesh%position(3, :), foil => component%section)
      ends = largest_over_ranks([maxval(x), -minval(x), maxval(z), -minval(z)])
      length = max(ends(1) + ends(2), ends(3) + ends(4))
      eigenvalue = foil%youngs_modulus*foil%thickness**2/(12.0_wp*(1.0_wp - foil%poissons_ratio**2)* &
                                                          foil%density*length**4)
    end associate
  end function plate_eigenvalue
end module gfb_modes_study
