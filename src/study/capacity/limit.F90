!> The load, speed, tilt or supply at which film, heat or asperities reach a limit: what is asked, and how far an answer is from it.
module gfb_limit
  use gfb_kinds, only: wp
  use gfb_units, only: rpm, micrometres, ice_point
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_text, only: text
  use gfb_bearing_case, only: pad_area
  use gfb_film_surface, only: translations
  use gfb_scene, only: scene_type
  use gfb_analysis_row, only: limit_load, limit_speed, limit_supply
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  implicit none (type, external)
  private
  public :: limit_of

  real(wp), parameter :: milliradians = 1.0e3_wp             !! in a radian
  real(wp), parameter :: kilopascals = 1.0e-3_wp             !! in a pascal
  real(wp), parameter :: bars = 1.0e-5_wp                    !! in a pascal
  real(wp), parameter :: pound_force = 4.4482216152605_wp    !! [N]
  real(wp), parameter :: inch = 0.0254_wp                    !! [m]
  real(wp), parameter :: growth = 2.0_wp                     !! of load, speed, tilt or supply in a step [1]
  real(wp), parameter :: pounds = inch**3*1000.0_wp*rpm/pound_force !! lbf/(in^3 krpm) in a N s/m^3

  !> The limit of a scene.
  type, public :: limit_type
    integer :: kind = 0               !! `limit_load`, ...
    integer :: axis = 1               !! of the tilt
    real(wp) :: smallest_gap = 0.0_wp !! [m]
    real(wp) :: highest_temperature = 0.0_wp !! of film and top foil; 0: none is given, or asperities decide [K]
    real(wp) :: ambient = 0.0_wp      !! temperature of the gas that is drawn in [K]
    real(wp) :: contact_part = 0.0_wp !! of the load [1]
    real(wp) :: pressure_around = 0.0_wp !! p_a [Pa]
    real(wp) :: supply = 0.0_wp       !! what all of a supply has above that [Pa]
    real(wp) :: direction(translations) = 0.0_wp !! of the load [1]
    real(wp) :: length = 0.0_wp       !! of the bearing [m]
    real(wp) :: diameter = 0.0_wp     !! [m]
    real(wp) :: arm = 0.0_wp          !! by which a tilt moves the film's edge [m]
    real(wp) :: area = 0.0_wp         !! of the pads of a thrust bearing; 0: it is a journal's [m2]
  contains
    procedure :: value_at, point_with, reserve, room, next_value, aimed_value, is_of_film, results, words, never_within, needs_none, course
    procedure, private :: coefficient, left_by_film, left_by_heat
  end type limit_type

contains

  !> The limit that a scene asks for, from the point where its answer is.
  pure function limit_of(scene, point) result(limit)
    type(scene_type), intent(in) :: scene !! that asks for a limit
    type(operating_point_type), intent(in) :: point !! whose load has the direction
    type(limit_type) :: limit

    limit%kind = scene%capacity%limit
    limit%axis = scene%capacity%tilt_axis
    limit%smallest_gap = scene%capacity%smallest_gap
    if (limit%is_of_film()) limit%highest_temperature = scene%capacity%highest_temperature
    limit%ambient = scene%thermal%ambient_temperature
    limit%contact_part = scene%capacity%contact_part
    limit%pressure_around = scene%gas%ambient_pressure
    limit%supply = scene%feed%supply_pressure - scene%gas%ambient_pressure
    associate (load => point%load(:translations))
      if (any(abs(load) > 0.0_wp)) limit%direction = load/norm2(load)
    end associate
    limit%length = scene%bearing%length
    limit%diameter = 2.0_wp*scene%bearing%radius
    limit%arm = 0.5_wp*limit%length
    if (scene%bearing%row%moves_across) return
    limit%arm = scene%bearing%radius
    limit%area = pad_area(scene%bearing)
  end function limit_of

  !> Whether it is the film that decides, and not the asperities.
  elemental logical function is_of_film(self) result(is)
    class(limit_type), intent(in) :: self !! the limit
    is = self%kind /= limit_speed
  end function is_of_film

  !> Value of what is looked for, at a point.
  pure function value_at(self, point) result(value)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! of the bearing
    real(wp) :: value !! load [N], speed [rad/s], tilt [rad] or supply over p_a [Pa]

    select case (self%kind)
    case (limit_load)
      value = dot_product(point%load(:translations), self%direction)
    case (limit_speed)
      value = point%speed
    case (limit_supply)
      value = point%supply*self%supply
    case default
      value = point%place(3 + self%axis)
    end select
  end function value_at

  !> A point with another load, speed, tilt or supply.
  pure function point_with(self, point, value) result(changed)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! of the bearing
    real(wp), intent(in) :: value !! load [N], speed [rad/s], tilt [rad] or supply over p_a [Pa]
    type(operating_point_type) :: changed

    changed = point
    select case (self%kind)
    case (limit_load)
      changed%load(:translations) = value*self%direction
    case (limit_speed)
      changed%speed = value
    case (limit_supply)
      changed%supply = value/self%supply
    case default
      changed%place(3 + self%axis) = value
    end select
  end function point_with

  !> What is left at the bearing's answer; 0 at the limit, negative beyond it: the film over the
  !> smallest one, less 1, or what heat leaves, where that is less; the logarithm of the part allowed over that of the asperities, nearly
  !> straight over the film: they carry exp(-h/s).
  function reserve(self, bearing) result(left)
    class(limit_type), intent(in) :: self !! the limit
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    real(wp) :: left !! [1]
    type(bearing_answer_type) :: answer
    real(wp) :: part

    answer = bearing_answer(bearing)
    if (self%is_of_film()) then
      left = self%left_by_film(answer%minimum_gap)
      if (self%highest_temperature > 0.0_wp) left = min(left, self%left_by_heat(answer))
    else
      part = contact_part(answer, bearing%point)
      left = log(self%contact_part/max(part, tiny(part)))
    end if
  end function reserve

  !> What the next value to try follows from: of a tilt, whose first step is as long as the film allows, what the film leaves even
  !> where heat leaves less; else the reserve.
  function room(self, bearing, left) result(of_film)
    class(limit_type), intent(in) :: self !! the limit
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    real(wp), intent(in) :: left !! its reserve [1]
    real(wp) :: of_film !! [1]

    of_film = left
    if (left > 0.0_wp .and. self%highest_temperature > 0.0_wp) of_film = self%left_by_film(bearing%smallest_gap())
  end function room

  !> How far the smallest film is above the one asked for, over that [1].
  pure real(wp) function left_by_film(self, gap) result(left)
    class(limit_type), intent(in) :: self !! the limit, of a film
    real(wp), intent(in) :: gap !! smallest film [m]
    left = gap/self%smallest_gap - 1.0_wp
  end function left_by_film

  !> How far the hottest place of film and top foil is below the highest temperature, over how far that is above the gas around [1].
  pure real(wp) function left_by_heat(self, answer) result(left)
    class(limit_type), intent(in) :: self !! the limit, with a highest temperature
    type(bearing_answer_type), intent(in) :: answer
    left = (self%highest_temperature - hottest_place(answer))/(self%highest_temperature - self%ambient)
  end function left_by_heat

  !> Temperature of the hottest place of film and top foil [K].
  pure real(wp) function hottest_place(answer) result(temperature)
    type(bearing_answer_type), intent(in) :: answer
    temperature = max(answer%heat%whole%maximum_film_temperature, answer%heat%whole%maximum_top_foil_temperature)
  end function hottest_place

  !> The value to try next: a larger load or tilt or a lower speed or supply while there is reserve; from
  !> beyond the limit a smaller load, a higher speed or supply, no tilt.
  pure real(wp) function next_value(self, value, left) result(next)
    class(limit_type), intent(in) :: self !! the limit
    real(wp), intent(in) :: value !! load [N], speed [rad/s], tilt [rad] or supply over p_a [Pa]
    real(wp), intent(in) :: left  !! reserve there [1]
    real(wp), parameter :: least_supply = 1.0e-3_wp !! over p_a, before none is tried [1]
    real(wp) :: tilt

    select case (self%kind)
    case (limit_load)
      next = value*merge(growth, 1.0_wp/growth, left > 0.0_wp)
    case (limit_speed, limit_supply)
      next = value*merge(1.0_wp/growth, growth, left > 0.0_wp)
      if (self%kind == limit_supply .and. next < least_supply*self%pressure_around) next = 0.0_wp
    case default
      next = 0.0_wp
      if (.not. left > 0.0_wp) return
      ! At least one by which the ends of the shaft come down as much as the film may lose.
      tilt = left*self%smallest_gap/self%arm
      next = sign(max(growth*abs(value), tilt), value)
    end select
  end function next_value

  !> Where the reserve would be none if it went on as its tangent does: over the logarithm of a load, speed or supply, as the film is next
  !> to a power of either; the value itself where the slope says nothing.
  pure real(wp) function aimed_value(self, value, left, slope) result(aim)
    class(limit_type), intent(in) :: self !! the limit
    real(wp), intent(in) :: value !! load [N], speed [rad/s], tilt [rad] or supply over p_a [Pa]
    real(wp), intent(in) :: left  !! reserve there [1]
    real(wp), intent(in) :: slope !! of the reserve [1/unit]
    real(wp), parameter :: longest = 3.0_wp !! logarithm of a step [1]

    aim = value
    if (.not. abs(slope) > 0.0_wp) return
    if (any(self%kind == [limit_speed, limit_load, limit_supply])) then
      if (abs(value) > 0.0_wp) aim = value*exp(max(-longest, min(longest, -left/(slope*value))))
    else
      aim = value - left/slope
    end if
  end function aimed_value

  !> What summary and history say of the limit.
  function results(self, point, reached) result(list)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! where it is
    logical, intent(in) :: reached !! film or asperities are at the limit asked for
    type(quantity_type), allocatable :: list(:)

    associate (value => self%value_at(point))
      select case (self%kind)
      case (limit_load)
        call add_result(list, 'load_capacity', value)
        if (.not. self%area > 0.0_wp) then
          call add_result(list, 'load_capacity_coefficient', pounds*self%coefficient(point))
          call add_result(list, 'load_capacity_coefficient_si', self%coefficient(point))
        end if
      case (limit_speed)
        call add_result(list, 'lift_off_speed_rpm', value/rpm)
      case (limit_supply)
        call add_result(list, 'lift_off_supply_pressure', self%pressure_around + value)
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
  pure real(wp) function contact_part(answer, point) result(part)
    type(bearing_answer_type), intent(in) :: answer
    type(operating_point_type), intent(in) :: point !! with the load
    part = norm2(answer%solid_force(:translations))/norm2(point%load(:translations))
  end function contact_part

  !> From where to where a step leads, for the lines that say how far a long run is; empty where both are the same in their digits.
  pure function course(self, from, to) result(words)
    class(limit_type), intent(in) :: self !! the limit
    real(wp), intent(in) :: from, to !! loads [N], speeds [rad/s], tilts [rad] or supplies [Pa]
    character(len=:), allocatable :: words, unit, first, last
    real(wp) :: scale, zero

    zero = 0.0_wp
    select case (self%kind)
    case (limit_load)
      scale = 1.0_wp
      unit = ' N'
    case (limit_speed)
      scale = 1.0_wp/rpm
      unit = ' rpm'
    case (limit_supply)
      scale = bars
      zero = self%pressure_around
      unit = ' bar'
    case default
      scale = milliradians
      unit = ' mrad'
    end select
    words = ''
    first = text((from + zero)*scale, 4)
    last = text((to + zero)*scale, 4)
    if (first /= last) words = ' from '//first//' to '//last//unit
  end function course

  !> The limit as a sentence without its end.
  function words(self, bearing) result(sentence)
    class(limit_type), intent(in) :: self !! the limit
    type(bearing_system_type), intent(in) :: bearing !! at it
    character(len=:), allocatable :: sentence
    type(bearing_answer_type) :: answer

    answer = bearing_answer(bearing)
    associate (value => self%value_at(bearing%point))
      select case (self%kind)
      case (limit_load)
        sentence = 'load capacity: '//text(value, 6)//' N, '
        if (self%area > 0.0_wp) then ! the speed of a ring's tip is what designers quote beside it
          sentence = sentence//text(kilopascals*value/self%area, 4)//' kPa on the pads at '// &
                     text(0.5_wp*self%diameter*bearing%point%speed, 4)//' m/s at the tip'
        else
          sentence = sentence//'coefficient '//text(pounds*self%coefficient(bearing%point), 3)//' lbf/(in^3 krpm)'
        end if
      case (limit_speed)
        sentence = 'lift-off speed: '//text(value/rpm, 6)//' rpm'
      case (limit_supply)
        sentence = 'lift-off supply pressure: '//text((value + self%pressure_around)*bars, 6)//' bar absolute'
      case default
        sentence = 'misalignment allowance: '//text(value*milliradians, 6)//' mrad about '// &
                   merge('x', 'y', self%axis == 1)
      end select
    end associate
    sentence = sentence//', smallest film '//text(answer%minimum_gap*micrometres, 4)//' um'
    if (self%highest_temperature > 0.0_wp) then
      sentence = sentence//', film and top foil at most '//text(hottest_place(answer) - ice_point, 4)//' C'
      if (self%left_by_heat(answer) < self%left_by_film(answer%minimum_gap)) sentence = sentence//': heat decides'
    end if
    if (.not. self%is_of_film()) then
      sentence = sentence//', asperities carry '// &
                 text(100.0_wp*contact_part(answer, bearing%point), 4)//' % of the load'
    end if
  end function words

  !> Whether the film is thicker than the limit without any supply.
  elemental logical function needs_none(self, point)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! of an answer with reserve
    needs_none = self%kind == limit_supply .and. .not. point%supply > 0.0_wp
  end function needs_none

  !> Says that no value tried had any reserve, the last of which the bearing is at.
  function never_within(self, bearing) result(sentence)
    class(limit_type), intent(in) :: self !! the limit
    !> at the lightest load, the highest speed or supply, or without tilt
    type(bearing_system_type), intent(in) :: bearing
    character(len=:), allocatable :: sentence
    type(bearing_answer_type) :: answer

    sentence = 'the smallest film is thinner than smallest_gap'
    if (self%highest_temperature > 0.0_wp) then
      answer = bearing_answer(bearing)
      if (self%left_by_heat(answer) < 0.0_wp) sentence = 'film and top foil are hotter than highest_temperature'
    end if
    associate (value => self%value_at(bearing%point))
      select case (self%kind)
      case (limit_load)
        sentence = sentence//' at every load tried, down to '//text(value, 3)//' N'
      case (limit_speed)
        sentence = 'the asperities carry more than contact_part of the load at every speed '// &
                   'tried, up to '//text(value/rpm, 3)//' rpm'
      case (limit_supply)
        sentence = sentence//' at every supply pressure tried, up to '// &
                   text((value + self%pressure_around)*bars, 3)//' bar absolute'
      case default
        sentence = sentence//' without any tilt about '//merge('x', 'y', self%axis == 1)
      end select
    end associate
  end function never_within
end module gfb_limit
