!> How derivatives by a key of the case file are made of differences.
module gfb_key_differences
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_study_cases, only: parameter_type
  use gfb_sweep_case, only: swept_key_type, swept_keys
  use gfb_operation_case, only: angular_speed
  use gfb_film_surface, only: translations, axial_coordinate
  use gfb_operating_point, only: operating_point_type
  use gfb_key_effect, only: moves_point, acts_on_speed, acts_on_load, acts_on_axial_load, &
                            acts_on_axial_gap, acts_on_film, acts_on_contacts, acts_on_gaps, &
                            acts_on_sheets, acts_on_shapes
  implicit none (type, external)
  private
  public :: difference_of, vibration_difference_of, present_value, step_of, changed_point
  public :: keeps_meshes, changes_foils

  !> part of what is changed, where little is lost to rounding [1]
  real(wp), parameter :: small = 4.0e-6_wp

  !> How a derivative by a key is made of differences.
  type, public :: difference_type
    real(wp) :: part = 2.0e-4_wp !! of the key, that it is changed by [1]
    !> of the values at one and two such steps on both sides; with these the error is of fourth
    !> order
    real(wp) :: weight(-2:2) = [1.0_wp, -8.0_wp, 0.0_wp, 8.0_wp, -1.0_wp]/12.0_wp
  end type difference_type

  !> the same of second order
  real(wp), parameter :: central(-2:2) = [0.0_wp, -0.5_wp, 0.0_wp, 0.5_wp, 0.0_wp]
  !> exact where all is linear
  real(wp), parameter :: forward(-2:2) = [0.0_wp, 0.0_wp, -1.0_wp, 1.0_wp, 0.0_wp]

  !> Along a change of the answer: by steps that are long against what rounding leaves of stiff
  !> contacts, or short ones, within which hardly any of them opens or closes.
  type(difference_type), parameter, public :: by_answer(2) = [difference_type(), &
                                                              difference_type(small, central)]

contains

  !> The differences that suit a key. Where it leaves the foils' stiffness alone little is lost to
  !> rounding. In thickness and material stiffness is a polynomial, or nearly one, of low degree.
  !> The shape of bumps is neither, and a pitch adds up along the strip.
  !> Gaps of contacts that stay as they are are part of the equations in proportion.
  pure function difference_of(key) result(difference)
    type(swept_key_type), intent(in) :: key !! that is changed
    type(difference_type) :: difference
    real(wp), parameter :: large = 5.0e-4_wp

    if (moves_point(key%acts_on)) difference = difference_type(small, central)
    select case (key%acts_on)
    case (acts_on_film, acts_on_contacts)
      difference = difference_type(small, central)
    case (acts_on_gaps)
      difference = difference_type(0.01_wp, forward)
    case (acts_on_sheets)
      difference = difference_type(large, central)
    case default
      return
    end select
  end function difference_of

  !> The same for small vibrations, where stiff contacts have most of what is rounded: steps are
  !> longer, but where they move contacts themselves hardly so, as none may open or close within.
  !> Longest by keys of film and heat, some of which move foils by little: shells that soften by 3 %
  !> have 2e-7 of a derivative rounded by such steps, 5e-6 by the others.
  pure function vibration_difference_of(key) result(difference)
    type(swept_key_type), intent(in) :: key !! that is changed
    type(difference_type) :: difference

    if (key%acts_on == acts_on_contacts) difference = difference_type(10.0_wp*small, central)
    if (key%acts_on == acts_on_film) difference%part = 1.0e-3_wp
  end function vibration_difference_of

  !> Value of a parameter at the answer: the sweep's where it changes that very key.
  pure function present_value(scene, parameter, point, at) result(value)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(parameter_type), intent(in) :: parameter !! the key
    type(operating_point_type), intent(in) :: point !! of the answer
    real(wp), intent(in), optional :: at !! [the sweep's unit]
    real(wp) :: value !! [its unit]
    type(swept_key_type), allocatable :: list(:)
    integer :: i

    value = parameter%value
    select case (parameter%key%acts_on)
    case (acts_on_speed)
      value = point%speed/angular_speed(1.0_wp)
    case (acts_on_load)
      value = norm2(point%load(:translations))
    case (acts_on_axial_load)
      value = -point%load(axial_coordinate)
    case (acts_on_axial_gap)
      value = -point%place(axial_coordinate)
    case default
      if (.not. present(at) .or. .not. allocated(scene%sweep%keys)) return
      list = swept_keys(scene%sweep)
      do i = 1, size(list)
        if (list(i)%label() == parameter%key%label()) value = at
      end do
    end select
  end function present_value

  !> By how much a key is changed [its unit]; 0 where it has no size.
  pure real(wp) function step_of(scene, key, difference, value) result(step)
    type(scene_type), intent(in) :: scene !! with the key
    type(swept_key_type), intent(in) :: key !! that is changed
    type(difference_type), intent(in) :: difference !! that it is for
    real(wp), intent(in) :: value !! of the key [its unit]

    step = difference%part*abs(value)
    if (key%is_gap()) step = difference%part*scene%bearing%clearance
  end function step_of

  !> Another load, the direction kept, another gap that is held, or another speed.
  pure type(operating_point_type) function changed_point(parameter, value, point) result(there)
    type(parameter_type), intent(in) :: parameter !! a key of `&operation`
    real(wp), intent(in) :: value !! of it [its unit]
    type(operating_point_type), intent(in) :: point !! of the answer

    there = point
    select case (parameter%key%acts_on)
    case (acts_on_speed)
      there%speed = angular_speed(value)
    case (acts_on_load)
      there%load(:translations) = point%load(:translations)*(value/norm2(point%load(:translations)))
    case (acts_on_axial_load)
      there%load(axial_coordinate) = -value
    case (acts_on_axial_gap)
      there%place(axial_coordinate) = -value
    case default
      return ! other keys of the point are lists, by which nothing is derived
    end select
  end function changed_point

  !> Whether a key moves neither the film's mesh nor the crests. A bump, or a strip, with a size of
  !> its own is built anew.
  elemental logical function keeps_meshes(key) result(keeps)
    type(swept_key_type), intent(in) :: key !! that changes

    select case (key%acts_on)
    case (acts_on_film, acts_on_contacts, acts_on_gaps)
      keeps = .true.
    case (acts_on_sheets, acts_on_shapes)
      keeps = key%element == 0
    case default
      keeps = .false.
    end select
  end function keeps_meshes

  !> Whether a key is one of the foils themselves: their sheets and shapes, not where they touch.
  elemental logical function changes_foils(key) result(changes)
    type(swept_key_type), intent(in) :: key !! that changes
    changes = key%acts_on == acts_on_sheets .or. key%acts_on == acts_on_shapes
  end function changes_foils
end module gfb_key_differences
