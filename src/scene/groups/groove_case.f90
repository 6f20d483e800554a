!> `&grooves`: narrow grooves on the shaft or the sleeve, in bands of the width.
module gfb_groove_case
  use gfb_kinds, only: wp
  use gfb_units, only: pi, turn
  use gfb_analysis_row, only: analysis_row_type
  use gfb_bearing_case, only: bearing_case_type, pad_rows, surface_of, inner_edge_sealed
  use gfb_errors, only: error_type
  use gfb_film_surface, only: film_surface_type
  use gfb_case_keys, only: case_keys_type, longest_list, any_value, between, from_to, &
                           not_negative, unless
  use gfb_groove_ends, only: end_open, end_land, fit_ends
  use gfb_groove_film, only: groove_type, groove_end_type
  use gfb_key_effect, only: acts_on_film, acts_on_all
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: groove_case_type, read_groove_case

  character(len=*), parameter, public :: groove_group = 'grooves'

  integer, parameter, public :: on_shaft = 1, on_sleeve = 2
  integer, parameter, public :: grooves_narrow = 1   !! infinitely many
  !> and what their number costs at the ends of bands
  integer, parameter, public :: grooves_with_ends = 2
  integer, parameter, public :: grooves_resolved = 3 !! as many as there are
  integer, parameter :: fewest_elements = 4 !! of a pitch
  ! Those that give the load of the rows of two programs to 2e-3, of 8 to 48 grooves.
  integer, parameter :: usual_of_pitch = 12 !! of a pitch at least
  integer, parameter :: usual_around = 192  !! of all of them at least
  integer, parameter, public :: resolved_rows = 40 !! across the width
  real(wp), parameter, public :: resolved_refinement = 20.0_wp !! of ridge, groove and band
  integer, parameter :: pumps_up = 1
  character(len=*), parameter :: member_words(*) = [character(len=6) :: 'shaft', 'sleeve']
  character(len=*), parameter :: model_words(*) = [character(len=16) :: 'narrow', &
                                                         'narrow_with_ends', 'resolved']
  character(len=*), parameter :: pumping_words(*) = [character(len=4) :: 'up', 'down']
  real(wp), parameter :: rounding = 1.0e-9_wp !! of places that are meant to be equal, relative
  real(wp), parameter :: most_grooves = 1000.0_wp
  !> lines of bands whose ends are weighed [rad]
  real(wp), parameter :: flattest = 0.05_wp, steepest = 1.5_wp
  !> Of a pitch, on which the jump at an end is spread: about as wide as the flow takes to become
  !> even.
  real(wp), parameter :: strip_part = 0.1_wp
  real(wp), parameter :: most_of_band = 0.2_wp !! that a strip may take

  !> A strip on which the jump of the pressure at the end of a band is spread.
  type :: strip_type
    real(wp) :: place(2) = 0.0_wp !! from lower to higher z, or radius [m]
    type(groove_end_type) :: end
  end type strip_type

  !> The grooves. Places are z, or radii of a thrust bearing.
  type :: groove_case_type
    logical :: present = .false. !! the group stands in the file
    integer :: member = 0        !! `on_shaft`, `on_sleeve`; 0: not known
    real(wp), allocatable :: angle(:) !! between lines and motion, one or one of each band [rad]
    real(wp) :: depth = 0.0_wp        !! [m]
    real(wp) :: ridge_part = 0.5_wp   !! of the pattern [1]
    real(wp), allocatable :: band_begin(:), band_end(:) !! [m]
    integer, allocatable :: pumping(:)                  !! of each band
    integer :: count = 0 !! grooves around; 0: not known
    integer :: model = grooves_narrow
    type(strip_type), allocatable :: strip(:) !! of all bands, where they cost something
  contains
    procedure, non_overridable :: mirrors, groove_at, row_ends, weigh_ends
    procedure, non_overridable :: are_resolved, usual_elements, whole_elements, line_angle, angle_of
  end type groove_case_type

contains

  !> Reads the group.
  subroutine read_groove_case(keys, grooves, bearing, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(groove_case_type), intent(out) :: grooves !! what `&grooves` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` and `&pads` ask for
    type(analysis_row_type), intent(in) :: analysis !! of the case file

    call keys%start_group(groove_group, optional=.true., present_in_file=grooves%present, &
                          misplaced=analysis%refusal(groove_group), acts_on=acts_on_film)
    call keys%idle(unless(grooves%present, 'the file has no group &grooves'))
    call keys%choice_key('on', grooves%member, member_words, 'which surface has the grooves: '// &
                         'that of the shaft or runner, or that of the sleeve, pads or ring', &
                         required=.true.)
    call keys%real_list_key('angle', grooves%angle, longest_list, 'rad', 'between the lines of '// &
                            'the grooves and the motion, one value or one of each band; of '// &
                            'thrust bearings the lines are logarithmic spirals', &
                            between(0.0_wp, 0.5_wp*pi), .true., 'required')
    call keys%real_key('depth', grooves%depth, 'm', &
        'of the grooves below the ridges, whose gap '// &
                       'is the clearance', not_negative, .true.)
    call keys%real_key('ridge_part', grooves%ridge_part, '1', 'width of a ridge over that of '// &
                       'ridge and groove', between(0.0_wp, 1.0_wp))
    call keys%real_list_key('band_begin', grooves%band_begin, longest_list, 'm', 'z where each '// &
                            'band of grooves begins, rising; of thrust bearings its radius; '// &
                            'between bands the surface is smooth', any_value, .true., 'required')
    call keys%act_on('band_begin', acts_on_all)
    call keys%real_list_key('band_end', grooves%band_end, longest_list, 'm', 'where each band '// &
                            'ends', any_value, .true., 'required')
    call keys%act_on('band_end', acts_on_all)
    call keys%word_list_key('pumping', grooves%pumping, pumping_words, longest_list, 'of each '// &
                            'band: where the motion drives the gas, to larger or to smaller z, '// &
                            'or radius', .true.)
    call keys%choice_key('model', grooves%model, model_words, 'what is solved: the limit of '// &
                         'infinitely many grooves; the same with what their number costs at '// &
                         'the ends of bands; or each of them on a mesh along its lines, on a '// &
                         'sleeve or ring that stands still')
    call keys%integer_key('count', grooves%count, 'grooves of a band around the shaft; in the '// &
                          'limit they are taken as infinitely many, and this says what that '// &
                          'leaves out', from_to(0.0_wp, most_grooves), default='0: not known')
    call keys%rule(groove_group, 'count', grooves%model > grooves_narrow .and. &
                   grooves%count == 0, "must be given with model = 'narrow_with_ends' or "// &
                   "'resolved'")
    call keys%rule(groove_group, 'angle', grooves%model == grooves_with_ends .and. &
                   any(grooves%angle < flattest .or. grooves%angle > steepest), 'must be from '// &
                   "0.05 to 1.5 rad with model = 'narrow_with_ends'")
    if (grooves%are_resolved()) then
      call keys%act_on('angle', acts_on_all)
      call keys%act_on('ridge_part', acts_on_all)
    end if
    if (grooves%present) call check_bands(keys, grooves, bearing)
    if (keys%mistakes() == 0) call find_ends(grooves, bearing)
  end subroutine read_groove_case

  !> Bands are given alike, lie on the pad and not on each other.
  subroutine check_bands(keys, grooves, bearing)
    type(case_keys_type), intent(inout) :: keys
    type(groove_case_type), intent(in) :: grooves
    type(bearing_case_type), intent(in) :: bearing
    real(wp) :: rows(2), slack
    integer :: i

    associate (first => grooves%band_begin, last => grooves%band_end, &
        bands => size(grooves%band_begin))
      if (bands == 0) return
      call check_length('band_end', size(last))
      call check_length('pumping', size(grooves%pumping))
      if (size(grooves%angle) > 1) call check_length('angle', size(grooves%angle))
      if (size(last) /= bands) return
      rows = pad_rows(bearing)
      slack = rounding*maxval(abs(rows))
      do i = 1, bands
        if (last(i) <= first(i)) then
          call keys%complain(groove_group, 'band_end', 'must be greater than band_begin, '// &
                             text(first(i))//' m', i)
        else if (bearing%length > 0.0_wp .and. (first(i) < rows(1) - slack .or. &
                                                last(i) > rows(2) + slack)) then
          call keys%complain(groove_group, trim(merge('band_begin', 'band_end  ', &
                             first(i) < rows(1) - slack)), 'must lie on the pad, between '// &
                             text(rows(1))//' and '//text(rows(2))//' m', i)
        end if
        if (i == 1) cycle
        if (first(i) >= last(i - 1) - slack) cycle
        call keys%complain(groove_group, 'band_begin', 'must not lie before the end of the '// &
                           'band before it, '//text(last(i - 1))//' m', i)
      end do
    end associate

  contains

    !> A list has a value of each band.
    subroutine check_length(key, values)
      character(len=*), intent(in) :: key
      integer, intent(in) :: values

      call keys%rule(groove_group, key, values > 0 .and. values /= size(grooves%band_begin), &
                     'has '//text(values)//' values, must have one of each of '// &
                     text(size(grooves%band_begin))//' bands')
    end subroutine check_length
  end subroutine check_bands

  !> Whether both halves of the width are alike: bands mirror each other, and pump against each
  !> other.
  pure logical function mirrors(self)
    class(groove_case_type), intent(in) :: self !! what `&grooves` asks for
    integer :: i

    mirrors = .true.
    if (.not. self%present) return
    associate (first => self%band_begin, last => self%band_end, n => size(self%band_begin))
      mirrors = n > 0 .and. size(last) == n .and. size(self%pumping) == n .and. &
        any(size(self%angle) == [1, n])
      if (.not. mirrors) return
      do i = 1, n
        mirrors = mirrors .and. self%pumping(i) /= self%pumping(n + 1 - i) .and. &
          abs(first(i) + last(n + 1 - i)) <= rounding*maxval(abs([first, last]))
        if (size(self%angle) == 1) cycle
        mirrors = mirrors .and. abs(self%angle(i) - self%angle(n + 1 - i)) <= rounding
      end do
    end associate
  end function mirrors

  !> The limit of the grooves at a place across the motion; without a share between bands, and where
  !> each groove is meshed.
  pure type(groove_type) function groove_at(self, along) result(groove)
    class(groove_case_type), intent(in) :: self !! what `&grooves` asks for
    real(wp), intent(in) :: along !! z, or radius [m]
    real(wp) :: angle
    integer :: i

    groove = groove_type()
    angle = self%line_angle(along)
    if (self%are_resolved() .or. .not. abs(angle) > 0.0_wp) return
    groove = groove_type(1.0_wp - self%ridge_part, self%depth, [cos(angle), sin(angle)], &
                         self%member == on_shaft)
    if (.not. allocated(self%strip)) return
    do i = 1, size(self%strip)
      associate (place => self%strip(i)%place)
        if (along >= place(1) .and. along <= place(2)) groove%end = self%strip(i)%end
      end associate
    end do
  end function groove_at

  !> The ends of bands where the pressure jumps: at the edges of the film, and where a land follows.
  pure subroutine find_ends(grooves, bearing)
    type(groove_case_type), intent(inout) :: grooves
    type(bearing_case_type), intent(in) :: bearing
    type(film_surface_type) :: surface
    real(wp) :: rows(2), place, width
    type(strip_type) :: strip
    integer :: band, k

    if (.not. grooves%present .or. grooves%model /= grooves_with_ends) return
    allocate (grooves%strip(0))
    surface = surface_of(bearing)
    rows = pad_rows(bearing)
    associate (first => grooves%band_begin, last => grooves%band_end, end => strip%end, &
               slack => rounding*maxval(abs(rows)))
      do band = 1, size(first)
        do k = 1, 2
          place = merge(first(band), last(band), k == 1)
          if (any(abs(merge(last, first, k == 1) - place) <= slack)) cycle ! another band follows
          end%band = band
          end%side = merge(1.0_wp, -1.0_wp, k == 1)
          end%outside = merge(end_open, end_land, abs(rows(k) - place) <= slack)
          if (end%outside == end_open .and. k == 1 .and. &
              bearing%inner_edge == inner_edge_sealed) cycle
          end%sense = merge(1.0_wp, -1.0_wp, (grooves%pumping(band) == pumps_up) .eqv. &
                            (k == 1 .eqv. end%outside == end_open))
          end%pitch = turn*surface%radius_at(place)/real(grooves%count, wp)
          width = min(strip_part*end%pitch, most_of_band*(last(band) - first(band)))
          strip%place = merge([place, place + width], [place - width, place], k == 1)
          end%spread = end%pitch/(strip%place(2) - strip%place(1))
          grooves%strip = [grooves%strip, strip]
        end do
      end do
    end associate
  end subroutine find_ends

  !> Finds what the ends of bands cost, by the linear film of a pitch at each.
  subroutine weigh_ends(self)
    class(groove_case_type), intent(inout) :: self !! what `&grooves` asks for
    type(error_type), allocatable :: error
    integer :: i, k

    if (.not. allocated(self%strip)) return
    do i = 1, size(self%strip)
      associate (end => self%strip(i)%end)
        do k = 1, i - 1
          if (self%strip(k)%end%outside /= end%outside) cycle
          if (abs(self%angle_of(self%strip(k)%end%band) - self%angle_of(end%band)) <= rounding) exit
        end do
        if (k < i) then
          end%fit = self%strip(k)%end%fit
        else
          call fit_ends(self%angle_of(end%band), self%ridge_part, end%outside, end%fit, error)
          if (allocated(error)) error stop 'an end of grooves that cannot be weighed'
        end if
      end associate
    end do
  end subroutine weigh_ends

  !> Angle between the lines of a band and the motion, without a sign [rad].
  pure real(wp) function angle_of(self, band) result(angle)
    class(groove_case_type), intent(in) :: self !! what `&grooves` asks for
    integer, intent(in) :: band !! its number
    angle = self%angle(min(band, size(self%angle)))
  end function angle_of

  !> Angle of the grooves' lines with the motion at a place across it, positive where they rise with
  !> theta; 0 between bands [rad].
  !>
  !> Lines that rise with theta drive gas up on a surface at rest, down on one that moves.
  pure real(wp) function line_angle(self, along) result(angle)
    class(groove_case_type), intent(in) :: self !! what `&grooves` asks for
    real(wp), intent(in) :: along !! z, or radius [m]
    integer :: i

    angle = 0.0_wp
    if (.not. self%present) return
    do i = 1, size(self%band_begin)
      if (along < self%band_begin(i) .or. along > self%band_end(i)) cycle
      angle = self%angle_of(i)
      if ((self%pumping(i) == pumps_up) .neqv. (self%member == on_sleeve)) angle = -angle
    end do
  end function line_angle

  !> Whether each groove is meshed.
  pure logical function are_resolved(self) result(resolved)
    class(groove_case_type), intent(in) :: self !! what `&grooves` asks for
    resolved = self%present .and. self%model == grooves_resolved
  end function are_resolved

  !> Elements around the shaft that usually suffice where each groove is meshed.
  pure integer function usual_elements(self) result(elements)
    class(groove_case_type), intent(in) :: self !! what `&grooves` asks for

    elements = 0
    if (self%count == 0) return
    elements = self%count*max(usual_of_pitch, (usual_around + self%count - 1)/self%count)
  end function usual_elements

  !> About so many elements around the shaft, a whole number of each pitch.
  pure integer function whole_elements(self, wanted) result(elements)
    class(groove_case_type), intent(in) :: self !! with a count
    integer, intent(in) :: wanted !! elements
    elements = self%count*max(fewest_elements, nint(real(wanted, wp)/real(self%count, wp)))
  end function whole_elements

  !> Places inside a width where bands, or strips at their ends, begin or end, rising [m].
  pure function row_ends(self, rows) result(ends)
    class(groove_case_type), intent(in) :: self !! what `&grooves` asks for
    real(wp), intent(in) :: rows(2) !! its ends [m]
    real(wp), allocatable :: ends(:)
    real(wp) :: slack
    integer :: i, k

    allocate (ends(0))
    if (.not. self%present) return
    slack = rounding*maxval(abs(rows))
    do i = 1, size(self%band_begin)
      call add(self%band_begin(i))
      if (allocated(self%strip)) then
        do k = 1, size(self%strip) ! rising, too
          associate (end => self%strip(k)%end)
            if (end%band == i) call add(self%strip(k)%place(merge(2, 1, end%side > 0.0_wp)))
          end associate
        end do
      end if
      call add(self%band_end(i))
    end do

  contains

    !> Adds a place where it is inside, and no other's.
    pure subroutine add(place)
      real(wp), intent(in) :: place

      if (place <= rows(1) + slack .or. place >= rows(2) - slack) return
      if (size(ends) > 0) then
        if (abs(place - ends(size(ends))) <= slack) return
      end if
      ends = [ends, place]
    end subroutine add
  end function row_ends
end module gfb_groove_case
