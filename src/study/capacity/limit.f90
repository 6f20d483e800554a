!> What a limit is of: load, speed or tilt, and how far the film or the asperities are from it.
module gfb_limit
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_load_capacity, analysis_lift_off
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  implicit none (type, external)
  private
  public :: limit_type, limit_of

  real(wp), parameter :: rpm = acos(-1.0_wp)/30.0_wp         !! [rad/s]
  real(wp), parameter :: micrometres = 1.0e6_wp              !! in a metre
  real(wp), parameter :: milliradians = 1.0e3_wp             !! in a radian
  real(wp), parameter :: pound_force = 4.4482216152605_wp    !! [N]
  real(wp), parameter :: inch = 0.0254_wp                    !! [m]
  real(wp), parameter :: growth = 2.0_wp                     !! of load, speed or tilt in a step [1]
  real(wp), parameter :: pounds = inch**3*1000.0_wp*rpm/pound_force !! lbf/(in^3 krpm) in a N s/m^3

  !> The limit of a scene.
  type :: limit_type
    integer :: question = 0           !! `analysis_load_capacity`, ...
    integer :: axis = 1               !! of the tilt
    real(wp) :: smallest_gap = 0.0_wp !! [m]
    real(wp) :: contact_part = 0.0_wp !! of the load [1]
    real(wp) :: direction(2) = 0.0_wp !! of the load [1]
    real(wp) :: length = 0.0_wp       !! of the bearing [m]
    real(wp) :: diameter = 0.0_wp     !! [m]
  contains
    procedure :: value_at
    procedure :: point_with
    procedure :: reserve
    procedure :: next_value
    procedure :: is_of_film
    procedure :: results
    procedure :: words
    procedure :: never_within
    procedure, private :: coefficient
  end type limit_type

contains

  !> The limit that a scene asks for, from the point where its answer is.
  pure function limit_of(scene, point) result(limit)
    type(scene_type), intent(in) :: scene !! that asks for a limit
    type(operating_point_type), intent(in) :: point !! whose load has the direction
    type(limit_type) :: limit

    limit%question = scene%capacity%question
    limit%axis = scene%capacity%tilt_axis
    limit%smallest_gap = scene%capacity%smallest_gap
    limit%contact_part = scene%capacity%contact_part
    if (any(abs(point%load) > 0.0_wp)) limit%direction = point%load/norm2(point%load)
    limit%length = scene%bearing%length
    limit%diameter = 2.0_wp*scene%bearing%radius
  end function limit_of

  !> Whether it is the film that tells, and not the asperities.
  elemental function is_of_film(self) result(is)
    class(limit_type), intent(in) :: self !! the limit
    logical :: is
    is = self%question /= analysis_lift_off
  end function is_of_film

  !> Value of what is looked for, at a point.
  pure function value_at(self, point) result(value)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! of the bearing
    real(wp) :: value !! load [N], speed [rad/s] or tilt [rad]

    select case (self%question)
    case (analysis_load_capacity)
      value = dot_product(point%load, self%direction)
    case (analysis_lift_off)
      value = point%speed
    case default
      value = point%tilt(self%axis)
    end select
  end function value_at

  !> A point with another load, speed or tilt.
  pure function point_with(self, point, value) result(changed)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! of the bearing
    real(wp), intent(in) :: value !! load [N], speed [rad/s] or tilt [rad]
    type(operating_point_type) :: changed

    changed = point
    select case (self%question)
    case (analysis_load_capacity)
      changed%load = value*self%direction
    case (analysis_lift_off)
      changed%speed = value
    case default
      changed%tilt(self%axis) = value
    end select
  end function point_with

  !> What is left at the bearing's answer; 0 at the limit, negative beyond it: the film over the
  !> smallest one, less 1; the logarithm of the part allowed over that of the asperities, nearly
  !> straight over the film: they carry exp(-h/s).
  function reserve(self, bearing) result(left)
    class(limit_type), intent(in) :: self !! the limit
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    real(wp) :: left !! [1]
    type(bearing_answer_type) :: answer
    real(wp) :: part

    answer = bearing_answer(bearing)
    if (self%is_of_film()) then
      left = answer%minimum_gap/self%smallest_gap - 1.0_wp
    else
      part = contact_part(answer, bearing%point)
      left = log(self%contact_part/max(part, tiny(part)))
    end if
  end function reserve

  !> The value to try next: a larger load or tilt or a lower speed while there is reserve; from
  !> beyond the limit a smaller load, a higher speed, no tilt.
  pure function next_value(self, value, left) result(next)
    class(limit_type), intent(in) :: self !! the limit
    real(wp), intent(in) :: value !! load [N], speed [rad/s] or tilt [rad]
    real(wp), intent(in) :: left  !! reserve there [1]
    real(wp) :: next
    real(wp) :: tilt

    select case (self%question)
    case (analysis_load_capacity)
      next = value*merge(growth, 1.0_wp/growth, left > 0.0_wp)
    case (analysis_lift_off)
      next = value*merge(1.0_wp/growth, growth, left > 0.0_wp)
    case default
      next = 0.0_wp
      if (.not. left > 0.0_wp) return
      ! At least one by which the ends of the shaft come down as much as the film may lose.
      tilt = left*self%smallest_gap/(0.5_wp*self%length)
      next = sign(max(growth*abs(value), tilt), value)
    end select
  end function next_value

  !> What summary and history say of the limit.
  function results(self, point, reached) result(list)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! where it is
    logical, intent(in) :: reached !! film or asperities are at the limit asked for
    type(quantity_type), allocatable :: list(:)

    associate (value => self%value_at(point))
      select case (self%question)
      case (analysis_load_capacity)
        call add_result(list, 'load_capacity', value)
        call add_result(list, 'load_capacity_coefficient', pounds*self%coefficient(point))
        call add_result(list, 'load_capacity_coefficient_si', self%coefficient(point))
      case (analysis_lift_off)
        call add_result(list, 'lift_off_speed_rpm', value/rpm)
      case default
        call add_result(list, 'misalignment_allowance', value)
      end select
    end associate
    call add_result(list, 'limit_reached', reached)
  end function results

  !> Designers' coefficient of a load, W/(L D D Omega). Source: [DellaCorteValco2000].
  pure function coefficient(self, point) result(value)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! with load and speed
    real(wp) :: value !! [N s/m^3]
    value = self%value_at(point)/(self%length*self%diameter**2*point%speed)
  end function coefficient

  !> Part of the load that the asperities carry [1].
  pure function contact_part(answer, point) result(part)
    type(bearing_answer_type), intent(in) :: answer
    type(operating_point_type), intent(in) :: point !! with the load
    real(wp) :: part
    part = norm2(answer%solid_force(:2))/norm2(point%load)
  end function contact_part

  !> The limit as a sentence without its end.
  function words(self, bearing) result(sentence)
    class(limit_type), intent(in) :: self !! the limit
    type(bearing_system_type), intent(in) :: bearing !! at it
    character(len=:), allocatable :: sentence
    type(bearing_answer_type) :: answer

    answer = bearing_answer(bearing)
    associate (value => self%value_at(bearing%point))
      select case (self%question)
      case (analysis_load_capacity)
        sentence = 'load capacity: '//text(value, 6)//' N, coefficient '// &
                   text(pounds*self%coefficient(bearing%point), 3)//' lbf/(in^3 krpm)'
      case (analysis_lift_off)
        sentence = 'lift-off speed: '//text(value/rpm, 6)//' rpm'
      case default
        sentence = 'misalignment allowance: '//text(value*milliradians, 6)//' mrad about '// &
                   merge('x', 'y', self%axis == 1)
      end select
    end associate
    sentence = sentence//', smallest film '//text(answer%minimum_gap*micrometres, 4)//' um'
    if (.not. self%is_of_film()) then
      sentence = sentence//', asperities carry '// &
                 text(100.0_wp*contact_part(answer, bearing%point), 4)//' % of the load'
    end if
  end function words

  !> Says that no value tried had any reserve, the last of which the bearing is at.
  function never_within(self, bearing) result(sentence)
    class(limit_type), intent(in) :: self !! the limit
    !> at the lightest load, the highest speed or without tilt
    type(bearing_system_type), intent(in) :: bearing
    character(len=:), allocatable :: sentence

    associate (value => self%value_at(bearing%point))
      select case (self%question)
      case (analysis_load_capacity)
        sentence = 'the smallest film is thinner than smallest_gap at every load tried, '// &
                   'down to '//text(value, 3)//' N'
      case (analysis_lift_off)
        sentence = 'the asperities carry more than contact_part of the load at every speed '// &
                   'tried, up to '//text(value/rpm, 3)//' rpm'
      case default
        sentence = 'the smallest film is thinner than smallest_gap without any tilt about '// &
                   merge('x', 'y', self%axis == 1)
      end select
    end associate
  end function never_within
end module gfb_limit
