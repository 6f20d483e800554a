#include "gfb_petsc.h"
!> A bump strip under given crest loads.
module gfb_strip_analysis
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, number_quantity, count_quantity, word_quantity, &
                          truth_quantity
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: wall_time, sum_over_ranks, rank_count
  use gfb_c_library, only: peak_memory
  use gfb_scene, only: scene_type
  use gfb_strip_load_case, only: crest_pressures
  use gfb_quad_mesh, only: quad_mesh_type, node_set
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure
  use gfb_substructures, only: kind_count
  use gfb_foil_builder, only: foil_plan_type, build_strip
  use gfb_linear_solve, only: solve_definite
  use gfb_case_file, only: history_row_type, case_array_type
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_foil_grid, only: create_foil_grid, add_displacement, add_stress
  use gfb_foil_plan, only: plan_foil
  use gfb_provenance, only: provenance, blas_in_use
  implicit none (type)
  private
  public :: run_strip

contains

  !> Computes a strip and writes its results.
  !>
  !> Fails on a strip that is not held, and when a file cannot be written.
  subroutine run_strip(scene, folder, command, start_time, log, error)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder   !! where the results go
    character(len=*), intent(in) :: command  !! the whole command line
    real(wp), intent(in) :: start_time       !! of the run [s]
    type(run_log_type), intent(in) :: log
    type(error_type), allocatable, intent(out) :: error

    type(foil_plan_type) :: plan
    type(foil_structure_type) :: strip
    type(history_row_type), allocatable :: history(:)
    type(quantity_type), allocatable :: summary(:)
    type(result_grid_type) :: grid
    real(wp), allocatable :: moved(:, :), deflection(:), force(:)
    Vec :: load, solution
    PetscErrorCode :: ierr

    call plan_foil(scene, log, plan)
    call log%heading('solution')
    call build_strip(scene, plan, strip, error)
    if (allocated(error)) return
    call log%line('super-elements: '//text(kind_count(strip%substructure))//' distinct of '// &
                  text(size(strip%substructure))//', '//text(strip%unknowns)//' unknowns')
    PetscCallA(MatCreateVecs(strip%stiffness, solution, load, ierr))
    call load_crests(strip, scene, plan, load, force)
    call solve_definite(strip%stiffness, load, 'foil_', solution, error)
    if (.not. allocated(error)) then
      allocate (moved(node_unknowns, size(strip%part%mesh_node)))
      call strip%displacements(solution, moved)
      deflection = crest_deflections(strip, scene%bump_foil%bumps, moved)
      summary = [strip_quantities(deflection, sum(force)), &
                 cost_quantities(scene, strip, start_time)]
      call show_closing_block(log, deflection, sum(force))
      allocate (history(1))
      history(1)%quantity = summary
      call create_foil_grid(strip, 'bump_foil', grid)
      call add_displacement(strip, 'displacement', 'of the mid-surface', moved, grid)
      call add_stress(strip, moved, grid)
      call write_result_set(scene, folder, .true., provenance(command), summary, history, &
                            [case_array_type ::], [grid], log, error)
    end if
    PetscCallA(VecDestroy(load, ierr))
    PetscCallA(VecDestroy(solution, ierr))
    call destroy_foil_structure(strip)
  end subroutine run_strip

  !> Loads every crest line with its bump's pressure, by the length each node stands for.
  subroutine load_crests(strip, scene, plan, load, force)
    type(foil_structure_type), intent(in) :: strip
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    Vec, intent(in) :: load
    real(wp), allocatable, intent(out) :: force(:) !! on each bump over the whole width [N]

    integer, parameter :: radial = 2
    real(wp), allocatable :: share(:)
    integer, allocatable :: line(:)
    integer :: bump, i, unknown
    PetscErrorCode :: ierr

    associate (foil => scene%bump_foil)
      force = crest_pressures(scene%strip_load, foil%bumps)*foil%pitch*foil%width
      do bump = 1, foil%bumps
        line = node_set(strip%mesh, 'crest_'//text(bump))
        share = line_shares(strip%mesh, line)
        do i = 1, size(line)
          if (strip%local_node(line(i)) == 0) cycle
          if (.not. strip%part%owned(strip%local_node(line(i)))) cycle
          unknown = strip%unknown(radial, line(i))
          PetscCallA(VecSetValue(load, int(unknown, pint), -force(bump)*merge(0.5_wp, 1.0_wp, plan%half)*share(i), ADD_VALUES, ierr))
        end do
      end do
    end associate
    PetscCallA(VecAssemblyBegin(load, ierr))
    PetscCallA(VecAssemblyEnd(load, ierr))
  end subroutine load_crests

  !> Share of a line's length that each of its nodes stands for (trapezoid rule); they add up to one.
  pure function line_shares(mesh, line) result(share)
    type(quad_mesh_type), intent(in) :: mesh
    integer, intent(in) :: line(:) !! nodes in order of z
    real(wp) :: share(size(line))
    integer :: i, n

    n = size(line)
    associate (z => mesh%position(3, line))
      do i = 1, n
        share(i) = 0.5_wp*(z(min(i + 1, n)) - z(max(i - 1, 1)))/(z(n) - z(1))
      end do
    end associate
  end function line_shares

  !> Mean deflection of each crest line towards the sleeve [m].
  function crest_deflections(strip, bumps, moved) result(deflection)
    type(foil_structure_type), intent(in) :: strip
    integer, intent(in) :: bumps
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes)
    real(wp) :: deflection(bumps)
    integer, allocatable :: line(:)
    real(wp), allocatable :: share(:)
    integer :: bump, i, local

    deflection = 0.0_wp
    do bump = 1, bumps
      line = node_set(strip%mesh, 'crest_'//text(bump))
      share = line_shares(strip%mesh, line)
      do i = 1, size(line)
        local = strip%local_node(line(i))
        if (local == 0) cycle
        if (strip%part%owned(local)) deflection(bump) = deflection(bump) - share(i)*moved(2, local)
      end do
    end do
    deflection = sum_over_ranks(deflection)
  end function crest_deflections

  !> Quantities of the answer.
  function strip_quantities(deflection, force) result(list)
    real(wp), intent(in) :: deflection(:) !! of the crests [m]
    real(wp), intent(in) :: force         !! on all bumps [N]
    type(quantity_type), allocatable :: list(:)
    integer :: bump

    list = [word_quantity('analysis', 'strip', 'kind of analysis'), &
            truth_quantity('converged', .true., 'whether the answer was found')]
    do bump = 1, size(deflection)
      list = [list, number_quantity('crest_deflection_'//text(bump), deflection(bump), 'm', &
                                    'mean deflection of a crest line towards the sleeve')]
    end do
    list = [list, &
            number_quantity('maximum_deflection', maxval(deflection), 'm', 'largest crest deflection'), &
            number_quantity('maximum_force', force, 'N', 'force on all crests')]
    if (maxval(deflection) > 0.0_wp) then
      list = [list, number_quantity('loading_stiffness', force/maxval(deflection), 'N/m', &
                                    'maximum force over maximum deflection')]
    end if
  end function strip_quantities

  !> Quantities of what it cost.
  function cost_quantities(scene, strip, start_time) result(list)
    type(scene_type), intent(in) :: scene
    type(foil_structure_type), intent(in) :: strip
    real(wp), intent(in) :: start_time !! [s]
    type(quantity_type), allocatable :: list(:)
    real(wp) :: memory(1)
    integer :: stations, rows

    stations = size(strip%mesh%position, 2)/strip%mesh%rows
    rows = scene%mesh%axial_elements + 1
    memory = sum_over_ranks([peak_memory()])
    list = [count_quantity('unknowns', strip%unknowns, 'unknowns of the equations'), &
            count_quantity('foil_unknowns_full', node_unknowns*stations*rows, &
                           'of the bump foil, whole width, before constraints'), &
            count_quantity('foil_unknowns_retained', node_unknowns*(size(strip%substructure) + 1)*rows, &
                           'of its retained lines, whole width, before constraints'), &
            count_quantity('distinct_super_elements', kind_count(strip%substructure), 'condensed once each'), &
            count_quantity('factorizations', 1, 'of the assembled stiffness'), &
            number_quantity('wall_time', wall_time() - start_time, 's', 'from start to answer'), &
            number_quantity('peak_memory', memory(1), 'B', 'sum over ranks of the largest held')]
  end function cost_quantities

  !> The answer in the units an engineer reads.
  subroutine show_closing_block(log, deflection, force)
    type(run_log_type), intent(in) :: log
    real(wp), intent(in) :: deflection(:) !! of the crests [m]
    real(wp), intent(in) :: force         !! on all bumps [N]
    integer :: bump

    call log%heading('answer')
    do bump = 1, size(deflection)
      call log%line('crest '//text(bump)//'  '//text(deflection(bump)*1.0e6_wp, 5)//' um')
    end do
    call log%line('force on all crests '//text(force, 5)//' N, '//text(rank_count())//' rank(s), BLAS '// &
                  blas_in_use())
  end subroutine show_closing_block
end module gfb_strip_analysis
