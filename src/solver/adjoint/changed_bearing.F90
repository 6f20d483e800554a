#include "gfb_petsc.h"
!> A bearing's equations at an answer's state with another value of a key of the case file.
module gfb_changed_bearing
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: any_rank, sum_over_ranks, share_failure
  use gfb_fixed_lines, only: fixed_line_half_flat
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: scene_with_key
  use gfb_study_cases, only: parameter_type
  use gfb_sweep_case, only: swept_key_type
  use gfb_operation_case, only: angular_speed
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_foil_builder, only: keep_elements
  use gfb_changed_foil, only: elastic_work
  use gfb_bearing_builder, only: build_like, take_numbers
  use gfb_answer_numbers, only: known_answer_type, measure
  implicit none (type)
  private
  public :: evaluate_changed

contains

  !> Residual and numbers at an answer's state with another value of a key; the bearing is as before on return.
  subroutine evaluate_changed(scene, parameter, value, bearing, answer, residual, number, work, problem, at)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(parameter_type), intent(in) :: parameter !! the key
    real(wp), intent(in) :: value !! of it [its unit]
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    type(known_answer_type), intent(in) :: answer !! what is known of it
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:) !! as `measure` has them [SI]
    real(wp), intent(out) :: work(:) !! of elastic forces that are not in the residual, on each adjoint
    character(len=:), allocatable, intent(out) :: problem !! why there are none; empty where there is none
    real(wp), intent(in), optional :: at !! where the scene's sweep is [its unit]
    type(scene_type) :: there
    type(error_type), allocatable :: error
    logical :: valid

    number = 0.0_wp
    work = 0.0_wp
    problem = ''
    valid = .true.
    if (parameter%key%group == 'operation') then
      call evaluate_operation(parameter, value, bearing, answer, residual, number, valid)
    else
      call scene_with_key(scene, parameter%key, value, there, error, at)
      if (allocated(error)) then
        problem = error%message
        return
      end if
      call keep_elements(scene, there)
      if (bearing%is_meshed() .and. keeps_meshes(scene, parameter%key)) then
        call evaluate_in_place(scene, there, parameter%key, bearing, answer, residual, number, work, valid, error)
      else
        call evaluate_rebuilt(there, bearing, answer, residual, number, valid, problem, error)
      end if
      if (allocated(error)) problem = error%message
    end if
    if (any_rank(.not. valid)) problem = 'the film is closed at a value close by'
  end subroutine evaluate_changed

  !> The same bearing at another load, the direction kept, or at another speed.
  subroutine evaluate_operation(parameter, value, bearing, answer, residual, number, valid)
    type(parameter_type), intent(in) :: parameter
    real(wp), intent(in) :: value !! [its unit]
    type(bearing_system_type), intent(inout) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    logical, intent(out) :: valid !! gap and pressure are positive
    type(operating_point_type) :: point

    point = bearing%point
    if (parameter%key%name == 'load') then
      point%load(:2) = point%load(:2)*(value/norm2(point%load(:2)))
    else
      point%speed = angular_speed(value)
    end if
    call bearing%evaluate_at(point, bearing%state, residual, valid)
    number = measure(bearing, answer%unknown, point, answer%nodes)
  end subroutine evaluate_operation

  !> Whether a key moves neither the film's mesh nor the crests.
  pure function keeps_meshes(scene, key) result(keeps)
    type(scene_type), intent(in) :: scene
    type(swept_key_type), intent(in) :: key
    logical :: keeps

    associate (name => key%name)
      select case (key%group)
      case ('gas', 'bore', 'contact', 'shaft_contact')
        keeps = .true.
      case ('bearing')
        keeps = name == 'clearance' .or. name == 'assembly_interference'
      case ('pads')
        keeps = name == 'preload' .or. name == 'preload_offset'
      case ('top_foil', 'bump_foil')
        keeps = name == 'thickness' .or. name == 'youngs_modulus' .or. name == 'poissons_ratio' .or. name == 'height' .or. &
                name == 'free_radius' .or. key%is_gap()
        ! else the first crest stands as far from the weld as half a bump is long
        if (name == 'half_length') keeps = scene%bump_foil%fixed_line == fixed_line_half_flat
      case default
        keeps = .false.
      end select
    end associate
  end function keeps_meshes

  !> The same bearing with other numbers. Its matrix of the foils stays; what changes in it is in the work.
  subroutine evaluate_in_place(scene, there, key, bearing, answer, residual, number, work, valid, error)
    type(scene_type), intent(in) :: scene, there !! as it is; with the key changed
    type(swept_key_type), intent(in) :: key !! that is changed
    type(bearing_system_type), intent(inout) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    real(wp), intent(inout) :: work(:) !! 0 where no foil is another
    logical, intent(out) :: valid !! gap and pressure are positive
    type(error_type), allocatable, intent(out) :: error
    real(wp) :: of_pad(size(work))
    logical :: of_bumps
    integer :: i

    call take_numbers(there, bearing)
    call bearing%evaluate_at(bearing%point, bearing%state, residual, valid)
    number = 0.0_wp ! they stay where the foils alone are others
    select case (key%group)
    case ('contact', 'top_foil', 'bump_foil')
    case default
      number = measure(bearing, answer%unknown, bearing%point, answer%nodes)
    end select
    call take_numbers(scene, bearing)
    of_bumps = key%group == 'bump_foil'
    if (key%is_gap() .or. .not. (of_bumps .or. key%group == 'top_foil')) return
    do i = 1, size(answer%motion)
      associate (pad => bearing%pad(i), motion => answer%motion(i))
        if (of_bumps) then
          call elastic_work(pad%foil, there, pad%whole, of_bumps, motion%bumps, of_pad, error)
        else
          call elastic_work(pad%foil, there, pad%whole, of_bumps, motion%top, of_pad, error)
        end if
      end associate
      if (allocated(error)) exit
      work = work + of_pad
    end do
    call share_failure(error)
    work = sum_over_ranks(work)
  end subroutine evaluate_in_place

  !> Another bearing on a mesh like this one's.
  subroutine evaluate_rebuilt(there, bearing, answer, residual, number, valid, problem, error)
    type(scene_type), intent(in) :: there
    type(bearing_system_type), intent(in) :: bearing
    type(known_answer_type), intent(in) :: answer
    type(tVec), intent(in) :: residual !! scaled
    real(wp), intent(out) :: number(:)
    logical, intent(out) :: valid !! gap and pressure are positive
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    type(error_type), allocatable, intent(out) :: error
    type(bearing_system_type) :: other

    number = 0.0_wp
    valid = .true.
    problem = ''
    call build_like(there, bearing, other, error)
    if (allocated(error)) return
    if (is_alike(bearing, other)) then
      call take_contacts(bearing, other)
      call other%set_unknowns(answer%unknown)
      call other%evaluate(other%state, residual, valid)
      number = measure(other, answer%unknown, other%point, answer%nodes)
    else
      problem = 'the mesh changes with it'
    end if
    call other%destroy()
  end subroutine evaluate_rebuilt

  !> Whether two bearings have the same unknowns and contacts.
  function is_alike(bearing, other) result(alike)
    type(bearing_system_type), intent(in) :: bearing, other
    logical :: alike

    alike = bearing%local_size() == other%local_size() .and. bearing%film_nodes() == other%film_nodes() .and. &
      size(bearing%pad(1)%foil%contacts%point) == size(other%pad(1)%foil%contacts%point)
    if (alike) alike = all(bearing%pad(1)%mesh%mesh_node == other%pad(1)%mesh%mesh_node)
    alike = .not. any_rank(.not. alike)
  end function is_alike

  !> Contacts of a bearing are linearised where those of another are.
  subroutine take_contacts(bearing, other)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_system_type), intent(inout) :: other
    integer :: i

    do i = 1, size(bearing%pad)
      if (.not. bearing%pad(i)%foil%has_contacts()) cycle
      call other%pad(i)%foil%contacts%settle_like(bearing%pad(i)%foil%contacts)
    end do
  end subroutine take_contacts
end module gfb_changed_bearing
