#include "gfb_petsc.h"
!> Starts from the answer of a smaller system: on a coarser mesh, or on half the width.
module gfb_smaller_start
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_film_mesh, only: find_film_place
  use gfb_bearing, only: film_values
  use gfb_bearing_system, only: bearing_system_type
  use gfb_continuation, only: path_report_type
  use gfb_start_problem, only: start_problem_type, soft_contacts_type
  use gfb_start_position, only: release_shaft, solve_at
  use gfb_full_width_start, only: take_full_width
  implicit none (type)
  private
  public :: try_smaller_answer, try_smaller_position, refine

  integer, parameter :: corners = 4 !! of an element

contains

  !> Newton's method at the target, from the smaller system's answer.
  recursive subroutine try_smaller_answer(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(soft_contacts_type), intent(in) :: soft  !! none
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends                  !! never

    ends = .false.
    call take_over(problem%smaller, problem%bearing)
    call solve_at(problem%bearing, problem%newton, problem%target, .false., problem%settings, report)
    problem%from_smaller = report%converged
  end subroutine try_smaller_answer

  !> The shaft is fixed where the smaller system's is, and then released.
  recursive subroutine try_smaller_position(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(soft_contacts_type), intent(in) :: soft  !! none
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends                  !! never
    type(operating_point_type) :: fixed

    ends = .false.
    call take_over(problem%smaller, problem%bearing)
    fixed = problem%target
    fixed%eccentricity = problem%bearing%eccentricity()
    call solve_at(problem%bearing, problem%newton, fixed, .true., problem%settings, report)
    if (report%converged) call release_shaft(problem%bearing, problem%newton, problem%target, problem%settings, report)
    problem%from_smaller = report%converged
  end subroutine try_smaller_position

  !> Takes an answer over from a smaller system: on half the width, or on a coarser mesh.
  subroutine take_over(small, bearing)
    type(bearing_system_type), intent(in) :: small
    type(bearing_system_type), intent(inout) :: bearing

    if (small%pad(1)%whole%half .and. .not. bearing%pad(1)%whole%half) then
      call take_full_width(small, bearing)
    else
      call refine(small, bearing)
    end if
  end subroutine take_over

  !> Takes pressure and position over from a coarser mesh.
  subroutine refine(coarse, fine)
    type(bearing_system_type), intent(in) :: coarse  !! with its answer
    type(bearing_system_type), intent(inout) :: fine !! gets a start value

    real(wp) :: rough(coarse%local_size()), unknown(fine%local_size())
    real(wp) :: share(corners, size(fine%pad(1)%mesh%mesh_node))
    integer :: around(corners, size(fine%pad(1)%mesh%mesh_node)), node

    call coarse%get_unknowns(rough)
    do node = 1, size(fine%pad(1)%mesh%mesh_node)
      call find_film_place(coarse%pad(1)%whole, fine%pad(1)%film%angle(node), fine%pad(1)%film%axial(node), around(:, node), share(:, node))
    end do
    unknown = 0.0_wp
    unknown(:size(share, 2)) = taken(rough(:size(coarse%pad(1)%mesh%mesh_node)) + coarse%solid_pressure(rough))
    call fine%pad(1)%foil%estimate(unknown)
    unknown(:size(share, 2)) = taken(rough(:size(coarse%pad(1)%mesh%mesh_node)))
    if (fine%floats) unknown(fine%first_shaft + 1:) = coarse%eccentricity()
    call fine%set_unknowns(unknown)

  contains

    !> A field of the coarse film at the fine one's nodes.
    function taken(value) result(there)
      real(wp), intent(in) :: value(:)
      real(wp) :: there(size(share, 2)), corner(corners, size(share, 2))

      corner = reshape(film_values(coarse, value, [around]), shape(corner))
      ! Less one corner's value: an even field stays so to the last digit.
      there = corner(1, :) + sum(share*(corner - spread(corner(1, :), 1, corners)), 1)
    end function taken
  end subroutine refine
end module gfb_smaller_start
